#!/bin/sh
# Checks that the command and the C library are not linked to OpenImageIO and its 250 libraries, that the
# command loads them when it reads or writes images, and that it reports an error if it cannot.
# Usage: images.sh READELF TOOL WORK [LIBRARY]
set -eu
readelf=$1 tool=$2 work=$3
for program in "$tool" ${4:+"$4"}; do
    if "$readelf" -d "$program" | grep NEEDED | grep OpenImageIO; then
        echo "$program is linked to OpenImageIO"
        exit 1
    fi
done
rm -rf "$work"
mkdir -p "$work"
cp "$tool" "$work/alone"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.3\nf 1 2 3\nf 1 3 4\n' >"$work/folded.obj"
"$work/alone" simplify "$work/folded.obj" "$work/geometry.glb" --ratio 1 --bake none --quiet
images="--ratio 1 --normal-map on --texture-size 64 --quiet"
"$tool" simplify "$work/folded.obj" "$work/textured.glb" $images
if "$work/alone" simplify "$work/folded.obj" "$work/none.glb" $images 2>"$work/errors"; then
    echo "the command has written an image without its image plugin"
    exit 1
fi
grep -q 'cannot load the image plugin: .*/faqem/faqem-images.so: cannot open' "$work/errors"
[ ! -e "$work/none.glb" ]
