"""Checks that compiled files run on other systems: libraries, versions of symbols, exported names."""

import re
import subprocess

# Libraries that PEP 600 allows, since every system with glibc has them, and those of Windows.
ALLOWED = {"ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1", "libc.so.6", "libgcc_s.so.1", "libm.so.6",
           "KERNEL32.dll", "msvcrt.dll"}
# Processors in platform tags, by their names in headers of files.
PROCESSORS = {"Advanced Micro Devices X86-64": "x86_64", "AArch64": "aarch64"}
NEWEST_GLIBC = (2, 34)


class BinaryError(Exception):
    """A compiled file would not run on other systems."""


def needed(file):
    """Returns the names of the shared libraries that a file needs."""
    return set(re.findall(r"(?:NEEDED|DLL Name:) +(.+)", _output("objdump", "-p", file)))


def processor(file):
    """Returns the processor that a file runs on, as platform tags name it."""
    return PROCESSORS[re.search(r"Machine: +(.+)", _output("readelf", "-hW", file))[1]]


def glibc_versions(file):
    """Returns the symbols of glibc that a file uses, by version: {(2, 34): ["dlopen"]}."""
    versions = {}
    for major, minor, name in re.findall(r"\*UND\*.*\(GLIBC_(\d+)\.(\d+)[\d.]*\) +(\S+)", _output("objdump", "-T", file)):
        versions.setdefault((int(major), int(minor)), []).append(name)
    return versions


def exported(file):
    """Returns the names that a file defines for others."""
    if file.suffix == ".dll":
        return set(re.findall(r"^\t\[ *\d+\] (\w+)$", _output("objdump", "-p", file), re.MULTILINE))
    lines = _output("nm", "-D", "--defined-only", file).splitlines()
    return {line.split()[-1] for line in lines}


def platform_tag(library, command):
    """Returns the true platform tag of two files. Raises BinaryError if one would not run on other systems."""
    for file in (library, command):
        others = needed(file) - ALLOWED
        if others:
            raise BinaryError(f"{file} needs {', '.join(sorted(others))}")
    others = [name for name in exported(library) if not name.startswith("faqem_")]
    if others:
        raise BinaryError(f"{library} exports {', '.join(sorted(others)[:5])}")
    if library.suffix == ".dll":
        return "win_amd64"
    newest = (2, 17)
    for file in (library, command):
        if "TEXTREL" in _output("readelf", "-dW", file):
            raise BinaryError(f"{file} has relocations in its code")
        versions = glibc_versions(file)
        for version in sorted(versions):
            if version > NEWEST_GLIBC:
                raise BinaryError(f"{file} needs glibc {version[0]}.{version[1]}: {', '.join(versions[version])}")
            newest = max(newest, version)
    return f"manylinux_{newest[0]}_{newest[1]}_{processor(library)}"


def _output(*command):
    return subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, text=True, check=True).stdout
