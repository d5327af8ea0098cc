"""Tests of shards as functions: of files of this machine, and of URLs where fsspec is installed."""

import hashlib
import importlib.util
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest

import faqem
from test_arrays import InFolder, flat_grid

count = 70  # of models: more than two groups of those by URL


def contents(folder):
    """The bytes of the results of a folder, by name."""
    return {file.name: file.read_bytes() for file in folder.rglob("*.ply")}


class Folder(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "in").mkdir()
        for i in range(count):
            faqem.save(flat_grid(4 + i % 5), self.folder / f"in/m{i}.ply")
        self.list = self.folder / "models.jsonl"
        faqem.command("list", self.folder / "in", "-o", self.list)
        self.out = self.folder / "out"
        self.options = {"faces": 10, "bake": "none", "format": "ply"}


class Batch(Folder):
    def test_the_shards_have_the_results_of_the_command_in_any_thread(self):
        faqem.command("batch", "--list", self.list, self.folder / "plain", "--faces=10", "--bake=none", "--format=ply")
        counts = []
        for shard in pickle.loads(pickle.dumps(faqem.batch.shards(self.list, 2))):
            def run(shard=shard):
                counts.append(faqem.batch.run_shard(*shard, self.out, **self.options))
            thread = threading.Thread(target=run)
            thread.start()
            thread.join()
        self.assertEqual(sum(shard["done"] for shard in counts), count)
        self.assertEqual(contents(self.out), contents(self.folder / "plain"))
        self.assertEqual(faqem.batch.merge(self.out), {"done": count})

    def test_errors_are_those_of_the_command(self):
        for kind, arguments, options in (
            (faqem.OptionError, (self.list, 2, 2, self.out), {}),
            (faqem.OptionError, (self.list, 0, 2, self.out), {"faxes": 1}),
            (faqem.InputError, (self.folder / "none", 0, 2, self.out), {}),
        ):
            with self.subTest(arguments=arguments, options=options), self.assertRaises(kind):
                faqem.batch.run_shard(*arguments, **options)
        faqem.batch.run_shard(self.list, 0, 2, self.out, **self.options)
        with self.assertRaisesRegex(faqem.Error, "1-of-2 is not complete"):
            faqem.batch.merge(self.out)
        with self.assertRaises(faqem.OptionError):
            faqem.batch.shards(self.list, 0)

    def test_a_killed_process_leaves_no_command(self):
        large = self.folder / "in/m0.ply"  # takes seconds
        faqem.save(flat_grid(700), large, overwrite=True)
        faqem.command("list", large, "-o", self.list, "--force")
        code = f"import faqem; faqem.batch.run_shard({str(self.list)!r}, 0, 1, {str(self.out)!r}, bake='none', ratio=0.5)"
        process = subprocess.Popen([sys.executable, "-c", code])
        records = self.out / ".faqem-batch"
        while not any("started" in file.read_text() for file in records.rglob("*.jsonl")):
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
        deadline = time.monotonic() + 60
        while not any("interrupted" in file.read_text() for file in records.rglob("*.jsonl")):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        self.assertEqual(faqem.batch.run_shard(self.list, 0, 1, self.out, bake="none", ratio=0.5)["done"], 1)


@unittest.skipUnless(importlib.util.find_spec("fsspec"), "fsspec is not installed")
class Urls(Folder):
    def setUp(self):
        super().setUp()
        self.list_url = f"file://{self.list}"

    def run_all(self, out, n=2, **options):
        return [faqem.batch.run_shard(*shard, out, **{**self.options, **options}) for shard in faqem.batch.shards(self.list_url, n)]

    def test_shards_by_url_have_the_same_results_and_a_second_run_begins_no_model(self):
        faqem.batch.run_shard(self.list, 0, 1, self.folder / "plain", **self.options)
        for url in ("file://" + str(self.out), "memory://out"):
            with self.subTest(url=url):
                first = self.run_all(url)
                self.assertEqual(sum(shard["done"] for shard in first), count)
                import fsspec
                target, root = fsspec.core.url_to_fs(url)
                records = {path: target.cat_file(path) for path in target.find(root)}
                results = {os.path.basename(path): data for path, data in records.items() if path.endswith(".ply")}
                self.assertEqual(results, contents(self.folder / "plain"))
                self.assertEqual(self.run_all(url), first)
                self.assertEqual(records, {path: target.cat_file(path) for path in target.find(root)})
                self.assertEqual(faqem.batch.merge(url), {"done": count})
                with self.assertRaisesRegex(faqem.OptionError, "other options"):
                    self.run_all(url, faces=20)
                # A result that is gone is made again, and a model that is none is refused.
                gone = next(path for path in records if path.endswith("m3.ply.ply"))
                target.rm_file(gone)
                self.assertEqual(self.run_all(url), first)
                self.assertEqual(hashlib.sha256(target.cat_file(gone)).digest(), hashlib.sha256(records[gone]).digest())

    def test_models_that_cannot_be_read_are_refused_and_formats_of_several_files_an_error(self):
        (self.folder / "in/m1.ply").unlink()
        (self.folder / "in/m2.ply").write_text("no model")
        shards = self.run_all("memory://refused")
        self.assertEqual([sum(shard[end] for shard in shards) for end in ("done", "refused")], [count - 2, 2])
        with self.assertRaises(faqem.UnsupportedError):
            self.run_all("memory://gltf", format="gltf")
        self.list.write_text(json.dumps({"id": "a", "input": "a.obj"}) + "\n")
        with self.assertRaises(faqem.UnsupportedError):
            self.run_all("memory://obj", n=1)


if __name__ == "__main__":
    unittest.main()
