#!/bin/sh
# Builds the Debian packages, extracts all of them into one directory, and uses the command and the libraries
# from there.
# Usage: deb.sh CPACK BUILD WORK CONSUMERS CXX CC
set -eu
cpack=$1 build=$2 work=$3 consumers=$4 cxx=$5 cc=$6
rm -rf "$work"
mkdir -p "$work/root"
"$cpack" -G DEB --config "$build/CPackConfig.cmake" -B "$work/packages" >"$work/cpack.log" 2>&1 || {
    cat "$work/cpack.log"
    exit 1
}
for name in faqem libfaqem-dev libfaqem0; do
    set -- "$work/packages/$name"*.deb
    [ -f "$1" ]
done
for deb in "$work"/packages/*.deb; do
    dpkg-deb --contents "$deb" >"$work/contents"
    if grep -vE ' \./(usr/.*)?$| \./usr/' "$work/contents" >"$work/outside"; then
        echo "$deb: files outside /usr:"
        cat "$work/outside"
        exit 1
    fi
    dpkg-deb --extract "$deb" "$work/root"
done
dpkg-deb --field "$work"/packages/libfaqem0*.deb Depends | grep -q libopenimageio
dpkg-deb --field "$work"/packages/libfaqem-dev_*.deb Depends | grep -q libfaqem0

# Builds programs with pkg-config, then runs the command. Nothing from the build directory is used.
PKG_CONFIG_PATH=$(dirname "$(find "$work/root" -name faqem.pc)")
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH")
export PKG_CONFIG_PATH LD_LIBRARY_PATH
"$cc" -std=c11 "$consumers/c/arrays.c" $(pkg-config --cflags --libs faqem-c) -o "$work/c"
"$work/c"
"$cxx" -std=c++20 "$consumers/arrays.cpp" $(pkg-config --cflags --libs faqem) -o "$work/arrays"
"$work/arrays"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n' >"$work/square.obj"
"$work/root/usr/bin/faqem" simplify "$work/square.obj" "$work/square.glb" --ratio 1 --normal-map on \
    --texture-size 64 --quiet
"$work/root/usr/bin/faqem" info "$work/square.glb" --json | grep -q '"faces": 2'
