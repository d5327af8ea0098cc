#!/bin/sh
# Compares SHA-256 sums of the output of the tool. Usage: run.sh MODELS_PROGRAM TOOL. The tools of the CMake presets
# release, debug and clang are tested as well if they exist.
set -eu
models=$1
tool=$2
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$models" "$work"

# hash TOOL MODEL THREADS OPTIONS: prints the SHA-256 sum of the model with its textures, and the history.
hash() {
    "$1" simplify "$2" "$work/out.glb" --force --quiet --threads "$3" --history "$work/out.hist" \
        --texture-size 128 $4
    cat "$work/out.glb" "$work/out.hist" | sha256sum | cut -d' ' -f1
}

runs=0
same=0
# compare TOOL THREADS DESCRIPTION: compares the sum for $model and $options with $first.
compare() {
    runs=$((runs + 1))
    if [ "$(hash "$1" "$model" "$2" "$options")" = "$first" ]; then
        same=$((same + 1))
    else
        echo "differs: $(basename "$model") $options, $3"
    fi
}
for model in "$work"/*.glb; do
    case $model in */out.glb) continue ;; esac
    for options in "--preset qem" "--preset paper" "--preset stmw" "--preset fast" "--preset balanced" \
        "--preset best" "--bake vertex" "--bake keep" "--bake none" "--virtual-edges=0.1" \
        "--visibility weighted" "--max-error 1% --bake none"; do
        first=$(hash "$tool" "$model" 1 "$options")
        for threads in 1 1 2 3 16; do compare "$tool" $threads "$threads threads"; done
        for preset in release debug clang; do
            other=$root/build/$preset/bin/faqem
            if [ -x "$other" ] && [ "$other" != "$tool" ]; then compare "$other" 3 "preset $preset"; fi
        done
    done
    echo "$(basename "$model"): $same of $runs outputs so far are identical"
done
echo "$same of $runs outputs are identical"
[ "$same" -eq "$runs" ]
