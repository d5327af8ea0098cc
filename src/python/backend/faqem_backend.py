"""Builds the wheel and the source distribution (PEP 517). Needs CMake and Ninja besides Python.

The wheel holds compiled files of a CMake build at the root of the repository, which setuptools cannot describe without
as much code, and it must have the same bytes wherever it is built.

Usage: faqem_backend.py wheel FOLDER [--preset PRESET]            libraries linked statically, for all systems
       faqem_backend.py wheel FOLDER --build BUILD                with the files that such a preset has built there
       faqem_backend.py wheel FOLDER --library SO --command FILE  with these files of another build, for this system
       faqem_backend.py sdist FOLDER
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

import archives
import binaries
import licences

ROOT = pathlib.Path(__file__).resolve().parents[3]
SOURCE = ROOT / "src/python"


def version():
    """Returns the version of include/faqem/version.hpp."""
    header = (ROOT / "include/faqem/version.hpp").read_text()
    return ".".join(re.search(rf"version_{part} = (\d+);", header)[1] for part in ("major", "minor", "patch"))


def metadata():
    """Returns the metadata of the distribution, with its README."""
    fields = (SOURCE / "backend/METADATA.in").read_text().replace("@VERSION@", version())
    return fields + "\n" + (SOURCE / "README.md").read_text()


def build_static(preset="wheel"):
    """Builds the library and the command by a preset. Returns their files, tag and licences."""
    subprocess.run(["cmake", "--preset", preset], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", "--preset", preset], cwd=ROOT, check=True)
    return static_build(ROOT / "build" / preset)


def static_build(build):
    """Returns the library and the command of such a build, their platform tag and licences."""
    for_windows = (build / "bin/faqem.exe").exists()
    library = build / "src/capi" / ("libfaqem_c.dll" if for_windows else "libfaqem_c.so")
    command = build / "bin" / ("faqem.exe" if for_windows else "faqem")
    return library, command, binaries.platform_tag(library, command), licences.bundled(build, for_windows)


def write_wheel(folder, library, command, platform, bundled):
    """Writes the wheel of two compiled files, and the image plugin beside the library, if any. Returns its path.

    library, command  the library libfaqem_c and the program faqem
    platform          platform tag
    bundled           texts of licences by file name
    """
    info = f"faqem-{version()}.dist-info"
    tag = f"py3-none-{platform}"
    files = {f"faqem/{file.name}": file.read_bytes() for file in (SOURCE / "faqem").iterdir() if file.is_file()}
    files["faqem/libfaqem_c" + (".dll" if library.suffix == ".dll" else ".so")] = library.read_bytes()
    files[f"faqem/{command.name}"] = command.read_bytes()
    plugin = library.with_name("faqem-images.so")
    if plugin.exists():
        files[f"faqem/{plugin.name}"] = plugin.read_bytes()
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: faqem\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{info}/entry_points.txt"] = b"[console_scripts]\nfaqem = faqem.__main__:main\n"
    files[f"{info}/licenses/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    for name, text in bundled.items():
        files[f"{info}/licenses/{name}"] = text
    path = pathlib.Path(folder) / f"faqem-{version()}-{tag}.whl"
    archives.write_wheel(path, info, files, executable={"faqem/faqem"})
    return path


def write_sdist(folder):
    """Writes what build_static() needs. Returns the path of the archive."""
    name = f"faqem-{version()}"
    files = {"PKG-INFO": metadata().encode()}
    executable = set()
    for top in ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "pyproject.toml", "cmake", "include", "src"):
        found = sorted((ROOT / top).rglob("*")) if (ROOT / top).is_dir() else [ROOT / top]
        for file in found:
            local = file.relative_to(ROOT)
            if not file.is_file() or {"__pycache__", "node_modules"} & set(local.parts):
                continue
            files[str(local)] = file.read_bytes()
            if file.stat().st_mode & 0o100:
                executable.add(str(local))
    path = pathlib.Path(folder) / f"{name}.tar.gz"
    archives.write_tar(path, name, files, executable)
    return path


# The hooks of PEP 517.


def get_requires_for_build_wheel(config_settings=None):
    return [tool for tool in ("cmake", "ninja") if not shutil.which(tool)]


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / f"faqem-{version()}.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text(metadata())
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    return write_wheel(wheel_directory, *build_static()).name


def build_sdist(sdist_directory, config_settings=None):
    return write_sdist(sdist_directory).name


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("kind", choices=["wheel", "sdist"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--preset", default="wheel")
    parser.add_argument("--build", type=pathlib.Path)
    parser.add_argument("--library", type=pathlib.Path)
    parser.add_argument("--command", type=pathlib.Path)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    if given.kind == "sdist":
        print(write_sdist(given.folder))
    elif given.library and given.command:
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        print(write_wheel(given.folder, given.library, given.command, platform, {}))
    else:
        print(write_wheel(given.folder, *(static_build(given.build) if given.build else build_static(given.preset))))


if __name__ == "__main__":
    sys.exit(main())
