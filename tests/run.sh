#!/bin/sh
# Builds faqem and runs its tests. Usage: tests/run.sh [--quick] [PRESET [CTEST-OPTION...]], a configure preset of
# CMakePresets.json; default: test. Needs Debian 12 or 13 and nothing else: packages are installed first.
# tests/run.sh --suite fresh [OPTION...] runs tests/fresh/run.sh instead.
# --quick leaves out what runs whole programs for long (the package, Python, the validator, the viewer, the soak,
# fuzzing, examples, the site), and runs each test program in one process: under two minutes.
set -eu
cd "$(dirname "$0")/.."
if [ "${1:-}" = --suite ]; then
    suite=${2:-}
    [ "$suite" = fresh ] || { echo "tests/run.sh: there is no suite '$suite' (known: fresh)" >&2; exit 2; }
    shift 2
    exec "tests/$suite/run.sh" "$@"
fi
quick=""
if [ "${1:-}" = --quick ]; then
    quick="^(package|python|validator|viewer|soak|fuzz|examples)/|^docs/(commands work|the site)"
    quick="$quick|^(faqem|step_counts|asset|bake|cli|openmesh)/"  # replaced by the tests programs/*
    shift
fi
preset=${1:-test}
[ $# -eq 0 ] || shift

echo "== packages"
case $preset in
    clang | fuzz) cmake/install-packages.sh test clang ;;
    *) cmake/install-packages.sh test ;;
esac
echo "== configure ($preset)"
cmake --preset "$preset"
echo "== build"
cmake --build --preset "$preset"
echo "== test"
ctest --preset "$preset" ${quick:+-C Quick -E "$quick"} "$@"
