"""Licences of the libraries that are part of the wheel."""

import pathlib
import re
import subprocess

# What is linked, and the Debian package with its licence.
_PACKAGES = {
    "CLI11": "libcli11-dev",
    "draco": "libdraco-dev",
    "eigen": "libeigen3-dev",
    "libdeflate": "libdeflate-dev",
    "libjpeg-turbo": "libjpeg62-turbo-dev",
    "libmd": "libmd-dev",
    "libpng": "libpng-dev",
    "libwebp": "libwebp-dev",
    "nlohmann-json": "nlohmann-json3-dev",
    "zlib": "zlib1g-dev",
}


def bundled(build):
    """Returns the texts of the licences by file name. Raises FileNotFoundError if one is missing.

    build  folder of the build by the preset wheel

    Debian's texts refer to files in /usr/share/common-licenses for the long ones, which other systems do not have, so that
    these are part of the result.
    """
    compiler = subprocess.run(["c++", "-dumpversion"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    packages = {**_PACKAGES, "libstdc++": f"libstdc++-{compiler}-dev"}
    files = {name: pathlib.Path("/usr/share/doc", package, "copyright") for name, package in packages.items()}
    files["meshoptimizer"] = build / "meshoptimizer/debian/copyright"
    files["three.js"] = build / "src/cli/report/viewer/node_modules/three/LICENSE"
    texts = {f"{name}.txt": file.read_bytes() for name, file in files.items()}
    return {**texts, **_common(texts.values())}


def _common(texts):
    """Returns the files that texts name, for example common-licenses/Apache-2.0, as Debian's texts call them."""
    folder = pathlib.Path("/usr/share/common-licenses")
    named = {name.decode() for text in texts for name in re.findall(rb"common-licenses/([A-Za-z]+(?:-[0-9.]*[0-9])?)", text)}
    return {f"common-licenses/{name}": (folder / name).read_bytes() for name in sorted(named)}
