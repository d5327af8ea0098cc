#!/bin/sh
# Installs a build, moves the installed tree, and checks that its CMake and pkg-config files are relocatable.
# Usage: install.sh CMAKE BUILD PREFIX
set -eu
cmake=$1 build=$2 prefix=$3
rm -rf "$prefix" "$prefix-first"
"$cmake" --install "$build" --prefix "$prefix-first" >/dev/null
mv "$prefix-first" "$prefix"
if grep -rIl --include='*.cmake' --include='*.pc' -e "$build" -e "$prefix-first" "$prefix"; then
    echo "these files contain the build directory or the original prefix"
    exit 1
fi
"$prefix/bin/faqem" --version
