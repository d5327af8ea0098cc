"""Tests of what is in the wheel besides the functions: the command, the names, the checks of the build."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

import faqem

scripts = pathlib.Path(os.environ["FAQEM_ENVIRONMENT"]) / "bin"


def run(*command):
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return done.returncode, done.stdout, done.stderr


class Command(unittest.TestCase):
    def test_it_has_the_options_and_exit_codes_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            calls = (["--version"], ["simplify", "--help"], [], ["simplify", "--no-such-option"],
                     ["info", "missing.glb"], ["simplify", "missing.glb", f"{folder}/out.glb", "--ratio", "0.1"])
            for arguments in calls:
                expected = run(os.environ["FAQEM_COMMAND"], *arguments)
                self.assertEqual(run(sys.executable, "-m", "faqem", *arguments), expected, arguments)
                self.assertEqual(run(scripts / "faqem", *arguments), expected, arguments)
        self.assertEqual(run(sys.executable, "-m", "faqem", "--version")[0], 0)

    def test_a_reader_that_closes_the_pipe_ends_it_like_other_programs(self):
        with subprocess.Popen([sys.executable, "-m", "faqem", "completion"], stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE) as process:
            process.stdout.close()
            process.wait()
        self.assertEqual(process.returncode, -signal.SIGPIPE)


class Names(unittest.TestCase):
    def test_all_are_there_and_others_are_not(self):
        for name in [*faqem.__all__, "__version__"]:
            self.assertIn(name, dir(faqem))
            self.assertIsNotNone(getattr(faqem, name))
        with self.assertRaisesRegex(AttributeError, "'simplfy'"):
            faqem.simplfy

    def test_the_types_name_every_option(self):
        from faqem import _options, _types

        self.assertEqual(set(_types.ModelOptions.__annotations__), {*_options.option_names(), "progress"})
        self.assertLess(set(_types.SimplifyOptions.__annotations__), set(_types.ModelOptions.__annotations__))

    def test_the_import_loads_neither_numpy_nor_the_library(self):
        code = "import sys, faqem; sys.exit(bool({'numpy', 'ctypes', 'faqem._library'} & set(sys.modules)))"
        self.assertEqual(run(sys.executable, "-c", code), (0, b"", b""))


class Backend(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        backend = os.environ.get("FAQEM_BACKEND")
        if not backend:
            raise unittest.SkipTest("the source tree is not at hand")
        sys.path.insert(0, backend)
        cls.addClassCleanup(sys.path.remove, backend)

    def test_the_bytes_of_archives_depend_on_names_and_content_only(self):
        import archives

        files = {"p/b.py": b"b", "p-1.dist-info/WHEEL": b"w", "p/a": b"a"}
        with tempfile.TemporaryDirectory() as folder:
            written = []
            for order in (list(files), sorted(files)):
                content = {name: files[name] for name in order}
                wheel, tar = (pathlib.Path(folder, f"{len(written)}{kind}") for kind in (".whl", ".tar.gz"))
                archives.write_wheel(wheel, "p-1.dist-info", content, {"p/a"})
                archives.write_tar(tar, "p-1", content, {"p/a"})
                written.append((wheel.read_bytes(), tar.read_bytes()))
            self.assertEqual(written[0], written[1])

    def test_texts_that_licences_refer_to_are_added(self):
        import licences

        if not os.path.exists("/usr/share/common-licenses/GPL-3"):
            self.skipTest("no system of Debian")
        found = licences._common([b"see `/usr/share/common-licenses/GPL-3'.", b"or /usr/share/common-licenses/LGPL-2.1."])
        self.assertEqual(list(found), ["common-licenses/GPL-3", "common-licenses/LGPL-2.1"])
        self.assertIn(b"GNU GENERAL PUBLIC LICENSE", found["common-licenses/GPL-3"])
        with self.assertRaises(FileNotFoundError):
            licences._common([b"/usr/share/common-licenses/NONE"])

    def test_files_that_need_other_libraries_get_no_portable_tag(self):
        import binaries

        command = pathlib.Path(os.environ["FAQEM_COMMAND"])
        with self.assertRaisesRegex(binaries.BinaryError, r"faqem needs .*lib.+\.so"):
            binaries.platform_tag(command, command)

    def test_newer_versions_of_glibc_are_found(self):
        import binaries

        versions = binaries.glibc_versions(os.environ["FAQEM_COMMAND"])
        self.assertIn((2, 2), versions)
        self.assertIn("malloc", versions[2, 2])


if __name__ == "__main__":
    unittest.main()
