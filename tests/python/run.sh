#!/bin/sh
# Builds the wheel, installs it into a new virtual environment with access to the system's numpy, and runs the
# tests there, outside the source tree.
# Usage: run.sh LIBRARY VERSION
set -eu
library=$1 version=$2
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM

"$here/../../src/python/build_wheel.sh" "$library" "$version" "$work/wheels"
"$PYTHON" -m venv --without-pip --system-site-packages "$work/env"
"$work/env/bin/python" -m pip install --quiet --no-index --no-deps --disable-pip-version-check "$work"/wheels/faqem-*.whl
cp "$here"/test_*.py "$work"
cd "$work"
PYTHONWARNINGS=error FAQEM_ENVIRONMENT="$work/env" FAQEM_EXPECTED_VERSION=$version \
    "$work/env/bin/python" -m unittest discover --start-directory "$work"
