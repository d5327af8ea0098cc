#!/bin/sh
# Builds the Python wheel on an x86-64 Debian 12: for any Linux on x86-64, or on aarch64 by a cross compiler, with glibc
# 2.34 or newer, or for Windows on x86-64 by mingw-w64. Packages that are needed are installed first. Downloads the sources
# of meshoptimizer, and of all libraries for Windows, from Debian, and the packages of the viewer by npm.
# Usage: src/python/build_wheel.sh FOLDER [aarch64|windows]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
case "$#=${2:-}" in
    1=) preset=wheel groups=wheel ;;
    2=aarch64 | 2=windows) preset=wheel-$2 groups="wheel $2" ;;
    *) echo "usage: src/python/build_wheel.sh FOLDER [aarch64|windows]" >&2 && exit 2 ;;
esac
"$root/cmake/install-packages.sh" $groups
[ $preset != wheel-windows ] || "$root/cmake/build-windows-libraries.sh" "$root/build/windows-libraries"
python3 "$here/backend/faqem_backend.py" wheel "$1" --preset $preset
