#!/bin/bash
# Measures how long builds take, in clones of HEAD in a temporary folder.
# Usage: tests/bench/build_times.sh [--runs N] [NAME...]; default: two runs of each of
#   quickstart  examples/quickstart.sh, with an empty compiler cache
#   cold        tests/run.sh, with an empty compiler cache
#   warm        tests/run.sh in another folder with the cache of `cold`, and the share of compilations found in it
#   engine      an edit of engine/engine.hpp, without cache: tests/run.sh --module engine; then all objects of the
#               preset test
#   options     an edit of options.hpp, without cache: tests/run.sh --module options/test_validate.cpp; then all objects
#               of the preset test
#   bake asset cli  an edit of one .cpp of the folder, without cache: tests/run.sh --module of its subfolder
# Packages must be installed, and nothing else should run. Prints seconds of wall time and of CPU time.
set -euo pipefail
source=$(cd "$(dirname "$0")/../.." && pwd)
runs=2
if [ "${1:-}" = --runs ]; then
    runs=$2
    shift 2
fi
[ $# -gt 0 ] || set -- quickstart cold warm engine options bake asset cli
work=$(mktemp -d "${TMPDIR:-/tmp}/faqem-build-times.XXXXXX")
trap 'rm -rf "$work"' EXIT
TIMEFORMAT="%R %U %S"

# measure TITLE COMMAND...: prints wall and CPU seconds; the output of the command goes to a log.
measure() {
    local title=$1 times
    shift
    if ! times=$({ time "$@" >"$work/log" 2>&1; } 2>&1); then
        echo "$title: failed" >&2
        tail -n 30 "$work/log" >&2
        exit 1
    fi
    awk -v title="$title" '{ printf "%-44s %6.0f s wall %6.0f s CPU\n", title, $1, $2 + $3 }' <<<"$times"
}

clone() {
    rm -rf "$work/$1"
    git clone -q "$source" "$work/$1"
    cd "$work/$1"
}

# edit FILE NUMBER: changes what every file that includes this one sees.
edit() {
    case $1 in
        *options.hpp) sed -i '/int build_times = /d; s/^struct Options {$/&\n    int build_times = '"$2"';/' "$1" ;;
        *) sed -i '/int build_times = /d' "$1" && echo "inline constexpr int build_times = $2;" >>"$1" ;;
    esac
    git diff --quiet "$1" && echo "$1 was not changed" >&2 && exit 1 || true
}

# edit_loop TITLE FILE FOLDER [CTEST-OPTION...]
edit_loop() {
    local title=$1 file=$2 folder=$3 run
    shift 3
    [ -d "$work/edit" ] || clone edit
    cd "$work/edit"
    git checkout -q .
    # The cache is for the first build only.
    tests/run.sh --module "$folder" "$@" >"$work/log" 2>&1
    for run in $(seq "$runs"); do
        edit "$file" "$run"
        CCACHE_DISABLE=1 measure "$title: build and run tests" tests/run.sh --module "$folder" "$@"
    done
}

# edit_all TITLE FILE: all objects that depend on the file.
edit_all() {
    local run
    git checkout -q .
    { cmake --preset test && cmake --build build/test; } >"$work/log" 2>&1
    for run in $(seq "$runs"); do
        edit "$2" "1$run"
        CCACHE_DISABLE=1 measure "$1: all objects" cmake --build build/test
    done
}

for name in "$@"; do
    for run in $(seq "$runs"); do
        case $name in
            quickstart)
                export CCACHE_DIR=$work/cache-$name
                rm -rf "$CCACHE_DIR"
                clone quickstart
                measure "quickstart" examples/quickstart.sh
                ;;
            cold)
                export CCACHE_DIR=$work/cache
                rm -rf "$CCACHE_DIR"
                clone cold
                measure "tests/run.sh, cold" tests/run.sh
                ;;
            warm)
                export CCACHE_DIR=$work/cache
                [ -d "$CCACHE_DIR" ] || { echo "warm: run it together with cold" >&2; exit 2; }
                mkdir -p "$work/another"
                clone another/folder
                ccache --zero-stats >/dev/null
                measure "tests/run.sh, cache of another folder" tests/run.sh
                ccache --print-stats | awk '
                    $1 ~ /^(direct_cache_hit|preprocessed_cache_hit)$/ { hits += $2; all += $2 }
                    $1 == "cache_miss" { all += $2 }
                    $1 == "called_for_link" || $1 == "called_for_preprocessing" { }
                    $1 ~ /^(could_not_use_precompiled_header|could_not_use_modules|bad_compiler_arguments|unsupported_source_language)$/ { all += $2 }
                    END { printf "    %d of %d compilations were found in the cache (%.1f%%)\n", hits, all, 100 * hits / all }'
                ;;
        esac
    done
    case $name in
        engine)
            edit_loop "engine/engine.hpp" include/faqem/engine/engine.hpp engine
            edit_all "engine/engine.hpp" include/faqem/engine/engine.hpp
            ;;
        options)
            edit_loop "options.hpp" include/faqem/options.hpp options/test_validate.cpp
            edit_all "options.hpp" include/faqem/options.hpp
            ;;
        bake) edit_loop "bake/atlas/packing.cpp" src/bake/atlas/packing.cpp bake/atlas ;;
        asset) edit_loop "asset/gltf/read/part.cpp" src/asset/gltf/read/part.cpp asset/gltf ;;
        cli) edit_loop "cli/commands/compare.cpp" src/cli/commands/compare.cpp cli/commands ;;
    esac
done
