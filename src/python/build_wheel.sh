#!/bin/sh
# Builds the Python wheel for any Linux on x86-64, or on aarch64 by a cross compiler, with glibc 2.34 or newer, on an
# x86-64 Debian 12. Packages that are needed are installed first. Downloads the source of meshoptimizer from Debian, and
# the packages of the viewer by npm.
# Usage: src/python/build_wheel.sh FOLDER [aarch64]
set -eu
case "$#=${2:-}" in
    1=) preset=wheel groups=wheel ;;
    2=aarch64) preset=wheel-aarch64 groups="wheel aarch64" ;;
    *) echo "usage: src/python/build_wheel.sh FOLDER [aarch64]" >&2 && exit 2 ;;
esac
here=$(cd "$(dirname "$0")" && pwd)
"$here/../../cmake/install-packages.sh" $groups
python3 "$here/backend/faqem_backend.py" wheel "$1" --preset $preset
