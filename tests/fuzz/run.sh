#!/bin/sh
# Runs fuzz targets one after the other. Usage: tests/fuzz/run.sh SECONDS [TARGET...]; default: all targets.
# Requires a build of the CMake preset `fuzz` (tests/run.sh fuzz). Failing inputs are written to build/fuzz/found, the
# corpora to build/fuzz/corpus.
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:?usage: tests/fuzz/run.sh SECONDS [TARGET...]}
shift
build=build/fuzz
[ $# -gt 0 ] || set -- bake glb gltf history image mtl obj off ply rounds simplify stl
"$build/tests/fuzz/fuzz_seeds" "$build/seeds"
scratch=$(mktemp -d /dev/shm/faqem-fuzz-XXXXXX)  # in memory, because the targets write and read files
trap 'rm -rf "$scratch"' EXIT
export TMPDIR="$scratch"
export LSAN_OPTIONS="suppressions=$PWD/tests/support/lsan-suppressions.txt:print_suppressions=0"
mkdir -p "$build/found"
for target in "$@"; do
    mkdir -p "$build/corpus/$target"
    dictionary=""
    words=tests/fuzz/$target.dict
    [ "$target" != glb ] || words=tests/fuzz/gltf.dict
    [ ! -f "$words" ] || dictionary="-dict=$words"
    echo "== $target, $seconds seconds"
    # shellcheck disable=SC2086  # an empty $dictionary must not become an argument
    "$build/tests/fuzz/fuzz_$target" $dictionary -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=120 \
        -max_len=8192 -print_funcs=0 -print_final_stats=1 -artifact_prefix="$build/found/$target-" \
        "$build/corpus/$target" "$build/seeds/$target"
done
