"""Licences of the libraries that are part of the wheel."""

import pathlib
import re
import subprocess

# What is linked, and the Debian package with its licence: on all systems, on Linux, and on Windows.
_HEADERS = {"CLI11": "libcli11-dev", "eigen": "libeigen3-dev", "nlohmann-json": "nlohmann-json3-dev"}
_LINUX = {
    "draco": "libdraco-dev",
    "libdeflate": "libdeflate-dev",
    "libjpeg-turbo": "libjpeg62-turbo-dev",
    "libmd": "libmd-dev",
    "libpng": "libpng-dev",
    "libwebp": "libwebp-dev",
    "zlib": "zlib1g-dev",
}
_WINDOWS = {
    "libstdc++": "g++-mingw-w64-x86-64-posix",
    "mingw-w64": "mingw-w64-x86-64-dev",
    "zlib": "libz-mingw-w64-dev",
}
# Debian's source packages of what is compiled first.
_LINUX_SOURCES = ["meshoptimizer"]
_WINDOWS_SOURCES = ["libdeflate", "libjpeg-turbo", "libpng1.6", "libwebp", "meshoptimizer"]


def bundled(build, for_windows):
    """Returns the texts of the licences by file name. Raises FileNotFoundError if one is missing.

    build        folder of the build by a preset for wheels
    for_windows  whether it is for Windows

    Debian's texts refer to files in /usr/share/common-licenses for the long ones, which other systems do not have, so that
    these are part of the result.
    """
    compiler = subprocess.run(["c++", "-dumpversion"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    packages = {**_HEADERS, **(_WINDOWS if for_windows else {**_LINUX, "libstdc++": f"libstdc++-{compiler}-dev"})}
    files = {name: pathlib.Path("/usr/share/doc", package, "copyright") for name, package in packages.items()}
    sources = build.parent / "windows-libraries/source" if for_windows else build
    for name in _WINDOWS_SOURCES if for_windows else _LINUX_SOURCES:
        files[name] = sources / name / "debian/copyright"
    files["three.js"] = build / "src/cli/report/viewer/node_modules/three/LICENSE"
    texts = {f"{name}.txt": file.read_bytes() for name, file in files.items()}
    return {**texts, **_common(texts.values())}


def _common(texts):
    """Returns the files that texts name, for example common-licenses/Apache-2.0, as Debian's texts call them."""
    folder = pathlib.Path("/usr/share/common-licenses")
    named = {name.decode() for text in texts for name in re.findall(rb"common-licenses/([A-Za-z]+(?:-[0-9.]*[0-9])?)", text)}
    return {f"common-licenses/{name}": (folder / name).read_bytes() for name in sorted(named)}
