#!/bin/sh
# Builds the Python wheel for any Linux on x86-64 with glibc 2.34 or newer, on Debian 12. Packages that are needed are
# installed first. Downloads the source of meshoptimizer from Debian, and the packages of the viewer by npm.
# Usage: src/python/build_wheel.sh FOLDER
set -eu
[ $# -eq 1 ] || { echo "usage: src/python/build_wheel.sh FOLDER" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
"$here/../../cmake/install-packages.sh" wheel
python3 "$here/backend/faqem_backend.py" wheel "$1"
