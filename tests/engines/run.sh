#!/bin/sh
# Runs the shards of a list on engines that start them, with faults: engines.py. Installs what they need: Ray and Dask from
# PyPI, for this run; Slurm, which needs root, from Debian. Needs a build of the preset `test`, or the folder of another.
# Usage: run.sh [BUILD] [--engine ray|dask|kubernetes|aws|ranks|slurm]...; without --engine all of them
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../../build/test
engines=""
while [ $# -gt 0 ]; do
    case $1 in
        --engine) engines="$engines ${2:?}" && shift ;;
        *) build=$1 ;;
    esac
    shift
done
engines=${engines:-ray dask kubernetes aws ranks slurm}
build=$(cd "$build" && pwd)
injector=$(find "$build/tests" -name '*injector*.so' | head -n 1)
[ -n "$injector" ] || { echo "$0: $build has no library that injects faults; build the preset test" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM

groups=engines
case " $engines " in *" slurm "*) groups="engines slurm" ;; esac
"$here/../../cmake/install-packages.sh" $groups
python3 -m venv "$work/env"
"$work/env/bin/pip" install --quiet --disable-pip-version-check numpy pyyaml ray==2.60.0 distributed==2026.8.0
python3 -B "$here/../../src/python/backend/faqem_backend.py" wheel "$work/wheels" \
    --library "$build/src/capi/libfaqem_c.so" --command "$build/bin/faqem"
"$work/env/bin/pip" install --quiet --disable-pip-version-check --no-index --no-deps "$work"/wheels/faqem-*.whl
cp "$here"/*.py "$here/../python"/test_*.py "$work"
cd "$work"
for engine in $engines; do
    limit=180
    [ "$engine" != slurm ] || limit=480
    timeout --signal=INT $limit "$work/env/bin/python" -B engines.py "$engine" "$injector" "$here/../../examples/batch"
done
# fsspec came with Dask.
timeout 180 "$work/env/bin/python" -B -m unittest test_batch
