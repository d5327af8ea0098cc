#!/bin/sh
# Builds the Blender extension of a wheel, validates it by Blender's command for extensions, and tries it with Blender as
# a Python module, which pip downloads (370 MB). Needs Python 3.11 or 3.13.
# Usage: tests/run.sh --suite blender [--wheel FILE]
# The wheel is that of tests/support/wheel.sh.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
suite=blender
. "$here/../support/wheel.sh"
case $(python3 -c "import sys; print('%d.%d' % sys.version_info[:2])") in
    3.11) version=5.0.1 numpy=1.26.4 ;;
    3.13) version=5.3.0 numpy=2.2.6 ;;
    *) skip "Python 3.11 or 3.13, for which there is a Blender" ;;
esac
pip --no-deps bpy==$version || skip "the package bpy $version of PyPI"
pip numpy==$numpy requests zstandard
extension=$(python3 -B "$source/src/blender/build_extension.py" "$wheel" "$work")
"$work/env/bin/python" -B "$work"/env/lib/python3*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py \
    validate "$extension"
export BLENDER_USER_RESOURCES="$work/settings"
mkdir "$work/results" "$work/settings"
timeout 240 "$work/env/bin/python" -B "$here/test_extension.py" "$extension" "$work/results" "$source/data/textured_quad.glb"
