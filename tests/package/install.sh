#!/bin/sh
# Installs a build, and moves it: what is installed must not know where. Usage: install.sh CMAKE BUILD PREFIX
set -eu
cmake=$1 build=$2 prefix=$3
rm -rf "$prefix" "$prefix-first"
"$cmake" --install "$build" --prefix "$prefix-first" >/dev/null
mv "$prefix-first" "$prefix"
if grep -rIl --include='*.cmake' --include='*.pc' -e "$build" -e "$prefix-first" "$prefix"; then
    echo "these files name the build or the first place"
    exit 1
fi
"$prefix/bin/faqem" --version
