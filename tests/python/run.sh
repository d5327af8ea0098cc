#!/bin/sh
# Builds the wheel, installs it into a new virtual environment with access to the system's numpy, and runs the
# tests and the blocks of docs/python.md there, outside the source tree.
# Usage: run.sh LIBRARY COMMAND VERSION
set -eu
library=$1 command=$2 version=$3
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM

"$PYTHON" -B "$here/../../src/python/backend/faqem_backend.py" wheel "$work/wheels" --library "$library" --command "$command"
"$PYTHON" -m venv --without-pip --system-site-packages "$work/env"
"$work/env/bin/python" -m pip install --quiet --no-index --no-deps --disable-pip-version-check "$work"/wheels/faqem-*.whl
cp "$here"/test_*.py "$here/run_page.py" "$work"
cd "$work"
PYTHONWARNINGS=error FAQEM_ENVIRONMENT="$work/env" FAQEM_EXPECTED_VERSION=$version FAQEM_COMMAND=$command \
    FAQEM_BACKEND="$here/../../src/python/backend" PYTHONDONTWRITEBYTECODE=1 \
    "$work/env/bin/python" -m unittest discover --start-directory "$work"
"$work/env/bin/python" "$work/run_page.py" "$here/../../docs/python.md"
