#!/bin/sh
# Builds and runs the array examples with pkg-config alone, and checks that they include no headers of other
# libraries.
# Usage: pkg_config.sh PREFIX CONSUMERS CXX CC [FLAG...]
set -eu
prefix=$1 consumers=$2 cxx=$3 cc=$4
shift 4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name faqem.pc)")
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH")
export PKG_CONFIG_PATH LD_LIBRARY_PATH

"$cxx" "$@" -std=c++20 "$consumers/arrays.cpp" $(pkg-config --cflags --libs faqem) -o "$work/arrays"
"$work/arrays"
"$cc" "$@" -std=c11 "$consumers/c/arrays.c" $(pkg-config --cflags --libs faqem-c) -o "$work/c"
"$work/c"
pkg-config --exact-version="$("$prefix/bin/faqem" --version | sed 's/^faqem //')" faqem faqem-c

"$cxx" -std=c++20 -M "$consumers/arrays.cpp" $(pkg-config --cflags faqem) | tr ' ' '\n' >"$work/headers"
grep -q faqem/simplify.hpp "$work/headers"
if grep -E 'OpenMesh|Eigen|OpenImageIO|png|jpeglib|webp|libdeflate|nlohmann|nanoflann|CLI|faqem/engine' "$work/headers"; then
    echo "faqem/simplify.hpp includes these headers of other libraries or of the engine"
    exit 1
fi
