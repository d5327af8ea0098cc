#!/bin/sh
# Builds faqem and runs its tests. Needs Debian 12 or 13 and nothing else: packages are installed first.
# Usage: tests/run.sh [PRESET [CTEST-OPTION...]]
#            all tests of a configure preset of CMakePresets.json; default: test
#        tests/run.sh --module FOLDER [CTEST-OPTION...]
#            builds what the tests of a folder of the source tree need, for example engine/queue or src/bake, and runs
#            them; in a build tree of its own (preset module)
#        tests/run.sh --module FILE [CATCH2-OPTION...]
#            the same for the tests of one file, for example options/test_validate.cpp
#        tests/run.sh --suite fresh|wheel|engines|blender|comfyui|ktx2|windows|aarch64|web [OPTION...]
#            tests/fresh/run.sh, tests/wheel/run.sh and so on
set -eu
cd "$(dirname "$0")/.."

seconds=$(date +%s)
# stage TITLE: prints a title with the seconds of the stage before it.
stage() {
    now=$(date +%s)
    echo "== $1 (after $((now - seconds)) s)"
    seconds=$now
}

case ${1:-} in
    --suite)
        suite=${2:-}
        case $suite in
            fresh | wheel | engines | blender | comfyui | ktx2 | windows | aarch64 | web) ;;
            *) echo "tests/run.sh: there is no suite '$suite' (known: fresh, wheel, engines, blender, comfyui, ktx2, windows, aarch64, web)" >&2 && exit 2 ;;
        esac
        shift 2
        exec "tests/$suite/run.sh" "$@"
        ;;
    --module)
        preset=module
        module=$(echo "${2:-}" | sed -E 's#/+$##; s#^\./##; s#^(tests|src|include/faqem/detail|include/faqem)/##')
        [ -n "$module" ] || { echo "tests/run.sh: --module needs a folder or file, for example engine/queue" >&2; exit 2; }
        shift
        ;;
    -*)
        sed -n '/^# Usage/,/^set/s/^# //p' "$0" >&2
        exit 2
        ;;
    *)
        preset=${1:-test}
        module=""
        ;;
esac
[ $# -eq 0 ] || shift

echo "== packages"
case $preset in
    clang | fuzz) cmake/install-packages.sh test clang ;;
    *) cmake/install-packages.sh test ;;
esac
if [ -z "$module" ]; then
    stage "configure ($preset)"
    cmake --preset "$preset"
    stage "build"
    cmake --build --preset "$preset"
    stage "test"
    ctest --preset "$preset" "$@"
else
    build=build/$preset
    if [ -f $build/build.ninja ]; then
        cmake --build $build --target build.ninja  # configures again if there are new files
    else
        cmake --preset $preset
    fi
    targets_of() {
        awk -v name="$1" '$1 == name || (index($1, name "/") == 1 && $1 !~ /\.cpp$/) { print $2 }' \
            $build/tests/modules | sort -u
    }
    # A file or folder without tests of its own is tested by those of the folder that contains it.
    while targets=$(targets_of "$module") && [ -z "$targets" ] && [ "$module" != "${module%/*}" ]; do
        module=${module%/*}
    done
    if [ -z "$targets" ]; then
        echo "tests/run.sh: no tests belong to '$module'; known:" \
            $(awk '$1 !~ /\.cpp$/ { print $1 }' $build/tests/modules) >&2
        exit 2
    fi
    stage "build $targets"
    cmake --build $build --target $targets
    stage "test"
    case $module in
        *.cpp) $build/tests/$targets "$@" ;;
        *) ctest --preset $preset -R "^$module(/|\$)" "$@" ;;
    esac
fi
stage "done"
