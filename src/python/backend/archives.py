"""Wheels, zips and source archives whose bytes depend on their files only: sorted, without owners, with a fixed time."""

import base64
import gzip
import hashlib
import io
import os
import tarfile
import time
import zipfile


def _seconds():
    """Time of all files: SOURCE_DATE_EPOCH, or the earliest time of a zip archive."""
    return max(int(os.environ.get("SOURCE_DATE_EPOCH", 0)), 315532800)


def write_zip(path, files, executable=()):
    """Writes a zip archive. Parameters as for write_wheel(); the files are in the order of `files`."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, time.gmtime(_seconds())[:6])
            entry.external_attr = (0o100755 if name in executable else 0o100644) << 16
            entry.create_system = 3  # Unix: the mode is valid
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content, compresslevel=9)


def write_wheel(path, info, files, executable):
    """Writes a wheel.

    path        file name
    info        name of the folder .dist-info
    files       content (bytes) by name, without RECORD, which is added
    executable  names of programs
    """
    record = []
    for name in sorted(files):
        digest = base64.urlsafe_b64encode(hashlib.sha256(files[name]).digest()).rstrip(b"=").decode()
        record.append(f"{name},sha256={digest},{len(files[name])}\n")
    record.append(f"{info}/RECORD,,\n")
    content = {**files, f"{info}/RECORD": "".join(record).encode()}
    # The metadata comes last, as recommended for wheels.
    names = sorted(content, key=lambda name: (name.startswith(info), name))
    write_zip(path, {name: content[name] for name in names}, executable)


def write_tar(path, folder, files, executable):
    """Writes a .tar.gz archive of files in a folder. Parameters as for write_wheel()."""
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for name in sorted(files):
            entry = tarfile.TarInfo(f"{folder}/{name}")
            entry.size = len(files[name])
            entry.mode = 0o755 if name in executable else 0o644
            entry.mtime = _seconds()
            archive.addfile(entry, io.BytesIO(files[name]))
    path.write_bytes(gzip.compress(packed.getvalue(), 9, mtime=0))
