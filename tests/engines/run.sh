#!/bin/sh
# Runs the shards of a list on Ray and on Dask, with faults: engines.py. Installs both from PyPI, for this run. Needs a
# build of the preset `test`, or the build folder that is given.
# Usage: run.sh [BUILD]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "${1:-$here/../../build/test}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM

python3 -m venv "$work/env"
"$work/env/bin/pip" install --quiet --disable-pip-version-check numpy ray==2.60.0 distributed==2026.8.0
python3 -B "$here/../../src/python/backend/faqem_backend.py" wheel "$work/wheels" \
    --library "$build/src/capi/libfaqem_c.so" --command "$build/bin/faqem"
"$work/env/bin/pip" install --quiet --disable-pip-version-check --no-index --no-deps "$work"/wheels/faqem-*.whl
cp "$here/engines.py" "$here/../python"/test_*.py "$work"
cd "$work"
injector=$(find "$build/tests" -name '*injector*.so' | head -n 1)
[ -n "$injector" ] || { echo "$0: $build has no library that injects faults; build the preset test" >&2; exit 1; }
for engine in ray dask; do
    timeout 180 "$work/env/bin/python" -B engines.py $engine "$injector"
done
# fsspec came with Dask.
timeout 180 "$work/env/bin/python" -B -m unittest test_batch
