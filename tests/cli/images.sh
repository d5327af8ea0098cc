#!/bin/sh
# Checks that programs and libraries start without OpenImageIO and its 250 libraries, and that the command reads and
# writes PNG, JPEG and WebP without its image plugin.
# Usage: images.sh TOOL WORK FILE... Each FILE is a program or library.
set -eu
tool=$1 work=$2
shift 2
for file in "$tool" "$@"; do
    ldd "$file" >"$work.ldd"
    if grep OpenImageIO "$work.ldd"; then
        echo "$file is linked to OpenImageIO"
        exit 1
    fi
done
rm -rf "$work"
mkdir -p "$work"
cp "$tool" "$work/alone"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n' >"$work/square.obj"
for format in png jpeg:90; do
    "$work/alone" simplify "$work/square.obj" "$work/$format.glb" --ratio 1 --normal-map on --texture-size 64 --quiet \
        --image-format $format
    "$work/alone" render "$work/$format.glb" "$work/$format.png" --size 64
    [ -s "$work/$format.png" ]
done
