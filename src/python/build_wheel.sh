#!/bin/sh
# Builds a Python wheel that contains the compiled C library. Needs no package index.
# Usage: build_wheel.sh LIBRARY VERSION OUTDIR
# LIBRARY is the file libfaqem_c.so. The image plugin faqem-images.so is taken from its directory, if present.
# The environment variable PYTHON selects the interpreter (default: python3).
set -eu
library=$1 version=$2 out=$3
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM

cp -R "$here/." "$work/source"
cp -L "$library" "$work/source/faqem/libfaqem_c.so"
images=$(dirname "$library")/faqem-images.so
[ ! -e "$images" ] || cp "$images" "$work/source/faqem/"
FAQEM_VERSION=$version "${PYTHON:-python3}" -m pip wheel --quiet --no-index --no-deps --no-build-isolation \
    --wheel-dir "$out" "$work/source"
