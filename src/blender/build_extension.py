"""Packs the Blender extension, which carries a wheel unmodified. Prints the path of the zip.

Usage: build_extension.py WHEEL FOLDER
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "python/backend"))

import archives  # noqa: E402


def main():
    wheel, folder = map(pathlib.Path, sys.argv[1:])
    version = wheel.name.split("-")[1]
    files = {file.name: file.read_bytes() for file in sorted((HERE / "extension").iterdir()) if file.is_file()}
    manifest = files["blender_manifest.toml"].decode().replace("@VERSION@", version).replace("@WHEEL@", wheel.name)
    files["blender_manifest.toml"] = manifest.encode()
    files["LICENSE"] = (HERE.parents[1] / "LICENSE").read_bytes()
    files[f"wheels/{wheel.name}"] = wheel.read_bytes()
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"faqem-{version}-linux_x64.zip"
    archives.write_zip(path, files)
    print(path)


main()
