"""Tests of calls in unusual places: interrupted, from several threads, after fork()."""

import concurrent.futures
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import faqem
import numpy
from numpy.testing import assert_array_equal
from test_compatible import bumpy_grid


class Interrupt(unittest.TestCase):
    def setUp(self):
        self.mesh = bumpy_grid(60)
        # A shell starts background processes with SIGINT ignored, and Python then installs no handler.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        self.before = signal.getsignal(signal.SIGINT)

    def interrupted_at(self, call, calls):
        """Returns a callback that notes its calls, and sends SIGINT to this process at the given one."""

        def progress(phase, done):
            calls.append(phase)
            if len(calls) == call:
                os.kill(os.getpid(), signal.SIGINT)

        return progress

    def test_it_ends_a_run_with_and_without_a_callback(self):
        calls = []
        with self.assertRaises(KeyboardInterrupt):
            faqem.simplify(*self.mesh, ratio=0.1, progress=self.interrupted_at(3, calls))
        self.assertLessEqual(len(calls), 3)
        code = ("import faqem, os, signal, threading, test_compatible as t\n"
                "mesh = t.bumpy_grid(700)\n"
                "threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
                "try: faqem.simplify(*mesh, ratio=0.01)\n"
                "except KeyboardInterrupt: print('interrupted')")
        done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.stdout, done.stderr), ("interrupted\n", ""))
        self.assertIs(signal.getsignal(signal.SIGINT), self.before)

    def test_a_handler_that_raises_nothing_lets_the_run_go_on(self):
        received, calls = [], []
        signal.signal(signal.SIGINT, lambda number, frame: received.append(number))
        self.addCleanup(signal.signal, signal.SIGINT, self.before)
        out = faqem.simplify(*self.mesh, ratio=0.1, progress=self.interrupted_at(2, calls))
        assert_array_equal(out.triangles, faqem.simplify(*self.mesh, ratio=0.1).triangles)
        self.assertEqual(received, [signal.SIGINT])
        self.assertGreater(len(calls), 2)

    def test_it_ends_levels_and_models_too(self):
        model = faqem.Model.from_arrays(*self.mesh)
        for run in (lambda progress: faqem.simplify_levels(*self.mesh, [0.5, 0.1], progress=progress),
                    lambda progress: faqem.simplify(model, ratio=0.1, progress=progress),
                    lambda progress: faqem.simplify_levels(model, [0.5, 0.1], progress=progress)):
            with self.assertRaises(KeyboardInterrupt):
                run(self.interrupted_at(2, []))

    def test_nothing_is_done_for_levels_that_are_complete(self):
        model = faqem.Model.from_arrays(*self.mesh)
        for run in (lambda progress: faqem.simplify_levels(*self.mesh, [0.5, 0.1], progress=progress, threads=1),
                    lambda progress: faqem.simplify_levels(model, [0.5, 0.1], progress=progress, threads=1, bake="none")):
            every = []
            run(self.interrupted_at(0, every))
            for call in range(2, len(every), 1 + len(every) // 6):
                calls = []
                with self.assertRaises(KeyboardInterrupt):
                    run(self.interrupted_at(call, calls))
                self.assertLessEqual(len(calls), call + 1)


class Processes(unittest.TestCase):
    def setUp(self):
        self.mesh = bumpy_grid(40)
        self.expected = faqem.simplify(*self.mesh, ratio=0.2).vertices

    def test_threads_may_call_at_once(self):
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for out in pool.map(lambda _: faqem.simplify(*self.mesh, ratio=0.2), range(16)):
                assert_array_equal(out.vertices, self.expected)

    def test_threads_may_use_one_model(self):
        # Vertex colours, which STL cannot store: each thread adds a warning to the model.
        vertices, triangles = self.mesh
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "coloured.obj")
            lines = [f"v {x} {y} {z} 0.5 0.5 {x / 40}" for x, y, z in vertices[:9]] + ["f 1 2 3", "f 4 5 6", "f 7 8 9"]
            file.write_text("\n".join(lines) + "\n")
            model = faqem.load(file)

            def use(number):
                for _ in range(50):
                    faqem.save(model, f"{folder}/{number}.stl", overwrite=True)
                    texts = model.warnings
                    faqem.simplify(model, ratio=1, bake="none")
                return texts

            with concurrent.futures.ThreadPoolExecutor(4) as pool:
                texts = [text for found in pool.map(use, range(4)) for text in found]
        self.assertEqual(len(model.warnings), 200)
        self.assertEqual(len(set(texts)), 1)

    def test_other_python_threads_run_during_a_call(self):
        mesh, ticks, stop = bumpy_grid(200), [], threading.Event()

        def count():
            while not stop.wait(0.001):
                ticks.append(None)

        counter = threading.Thread(target=count)
        counter.start()
        faqem.simplify(*mesh, ratio=0.01)
        stop.set()
        counter.join()
        self.assertGreater(len(ticks), 2)

    def test_a_forked_process_may_call(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python 3.12 warns of other threads, which are idle here
            child = os.fork()
        if child == 0:
            status = 1
            try:
                status = int(not numpy.array_equal(faqem.simplify(*self.mesh, ratio=0.2, threads=2).vertices, self.expected))
            finally:
                os._exit(status)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


if __name__ == "__main__":
    unittest.main()
