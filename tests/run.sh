#!/bin/sh
# Installs dependencies, builds faqem and runs all tests, on Debian 12.
# Usage: tests/run.sh [--quick] [PRESET [CTEST-OPTION...]]; PRESET is a configure preset of CMakePresets.json,
# default:
# release.
# --quick omits slow tests (package, Python, validator, viewer, soak, fuzzing, examples, documentation site)
# and runs each test program in one process, in under two minutes.
set -eu
cd "$(dirname "$0")/.."
quick=""
if [ "${1:-}" = --quick ]; then
    quick="^(package|python|validator|viewer|soak|fuzz|examples)/|^docs/(commands work|the site)"
    quick="$quick|^(faqem|step_counts|asset|bake|cli|openmesh)/"  # replaced by the tests programs/*
    shift
fi
preset=${1:-release}
[ $# -eq 0 ] || shift

echo "== packages"
case $preset in
    clang | fuzz) cmake/install-packages.sh clang ;;
    *) cmake/install-packages.sh ;;
esac
echo "== configure ($preset)"
cmake --preset "$preset" -DFAQEM_BUILD_TESTS=ON  # the quick start may have turned them off
echo "== build"
cmake --build --preset "$preset"
echo "== test"
ctest --preset "$preset" ${quick:+-C Quick -E "$quick"} "$@"
