#!/bin/sh
# Builds the plugin for KTX2 images, and reads images with it that the package alktx2 of PyPI makes. cargo downloads the
# source of Basis Universal.
# Usage: tests/run.sh --suite ktx2
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
build=$source/build/ktx2
[ $# -eq 0 ] || { echo "usage: tests/run.sh --suite ktx2" >&2; exit 2; }
skip() {
    echo "skipped: the suite ktx2 needs $1"
    exit 0
}
cargo --version 2>/dev/null | grep -Eq '^cargo (1\.(8[5-9]|9[0-9]|[1-9][0-9][0-9])|[2-9])' || skip "cargo 1.85 or newer"
"$source/cmake/install-packages.sh" ktx2 || skip "packages of Debian"
[ -d "$build/basisu/zstd" ] || "$source/src/ktx2_plugin/fetch_basisu.sh" "$build/basisu" || skip "the crate basisu_c_sys 0.9.1"
work=$(mktemp -d "${TMPDIR:-/tmp}/faqem-ktx2.XXXXXX")
trap 'rm -rf "$work"' EXIT INT TERM
python3 -m venv "$work/env"
"$work/env/bin/pip" install --quiet --disable-pip-version-check --no-cache-dir alktx2==0.1.7 numpy ||
    skip "the packages alktx2 0.1.7 and numpy of PyPI"
# As the preset test, so that most objects are those of its build.
cmake -S "$source" --preset test -B "$build" -DFAQEM_BUILD_TESTS=OFF -DFAQEM_WITH_KTX2=ON
cmake --build "$build" --target faqem_c

# The Python module with the plugin beside its library, and without.
for folder in with without; do
    mkdir "$work/$folder"
    cp -R "$source/src/python/faqem" "$work/$folder"
    cp "$build/src/capi/libfaqem_c.so" "$work/$folder/faqem"
done
cp "$build/src/capi/faqem-ktx2.so" "$work/with/faqem"
PYTHONPATH=$work/with timeout 600 "$work/env/bin/python" -B "$here/test_ktx2.py" "$work/without"
