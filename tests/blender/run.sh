#!/bin/sh
# Builds the Blender extension of a wheel, validates it by Blender's command for extensions, and tries it with Blender as
# a Python module, which pip downloads (370 MB). Needs Python 3.11 or 3.13, and a build of the preset `test`, whose
# libraries make the wheel, or another wheel.
# Usage: tests/run.sh --suite blender [--wheel FILE]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
wheel=""
case "$#=${1:-}" in
    0=) ;;
    2=--wheel) wheel=$(realpath "$2") ;;
    *) echo "usage: tests/run.sh --suite blender [--wheel FILE]" >&2 && exit 2 ;;
esac
skip() {
    echo "skipped: the suite blender needs $1"
    exit 0
}
"$source/cmake/install-packages.sh" blender || skip "packages of Debian"
case $(python3 -c "import sys; print('%d.%d' % sys.version_info[:2])") in
    3.11) version=5.0.1 numpy=1.26.4 ;;
    3.13) version=5.3.0 numpy=2.2.6 ;;
    *) skip "Python 3.11 or 3.13, for which there is a Blender" ;;
esac
work=$(mktemp -d "${TMPDIR:-/tmp}/faqem-blender.XXXXXX")
trap 'rm -rf "$work"' EXIT INT TERM
python3 -m venv "$work/env"
pip() { "$work/env/bin/pip" install --quiet --disable-pip-version-check --no-cache-dir "$@"; }
pip --no-deps bpy==$version || skip "the package bpy $version of PyPI"
pip numpy==$numpy requests zstandard
if [ -z "$wheel" ]; then
    build=$source/build/test
    wheel=$(python3 -B "$source/src/python/backend/faqem_backend.py" wheel "$work" \
        --library "$build/src/capi/libfaqem_c.so" --command "$build/bin/faqem")
fi
extension=$(python3 -B "$source/src/blender/build_extension.py" "$wheel" "$work")
"$work/env/bin/python" -B "$work"/env/lib/python3*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py \
    validate "$extension"
export BLENDER_USER_RESOURCES="$work/settings"
mkdir "$work/results" "$work/settings"
timeout 240 "$work/env/bin/python" -B "$here/test_extension.py" "$extension" "$work/results" "$source/data/textured_quad.glb"
