#!/bin/sh
# Configures a project that contains faqem's sources, compiles one of its files, and checks that nothing is
# installed.
# Usage: embed.sh CMAKE SOURCE WORK HOW CXX
set -eu
cmake=$1 source=$2 work=$3 how=$4 cxx=$5
rm -rf "$work"
"$cmake" -G Ninja -S "$source/tests/embedding" -B "$work" -DFAQEM_SOURCE="$source" -DHOW="$how" \
    -DCMAKE_CXX_COMPILER="$cxx" >"$work.log" 2>&1 || { cat "$work.log"; exit 1; }
"$cmake" --build "$work" --target CMakeFiles/embedding.dir/embedding.cpp.o
"$cmake" --install "$work" --prefix "$work/installed"
if [ -e "$work/installed" ]; then
    echo "faqem was installed with the project that contains it, although FAQEM_INSTALL is off"
    exit 1
fi
