#!/bin/sh
# Checks files written by the command with the Khronos glTF validator. Usage: run.sh FAQEM MAKE_MODEL MODULES
# WORK
set -eu
faqem=$1 make_model=$2 modules=$3 work=$4
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
"$make_model" "$work/model.glb" --faces 6000
for bake in per-triangle vertex keep none; do
    "$faqem" simplify "$work/model.glb" "$work/$bake.glb" --ratio 0.2 --bake $bake --texture-size 256 --quiet
done
"$faqem" simplify "$work/model.glb" "$work/normal-map.glb" --ratio 0.2 --texture-size 256 --normal-map on \
    --image-format jpeg --quiet
"$faqem" simplify "$work/normal-map.glb" "$work/kept-normal-map.glb" --ratio 0.5 --bake keep --quiet
"$faqem" simplify "$work/normal-map.glb" "$work/twice.glb" --ratio 0.5 --texture-size 256 --normals flat --quiet
"$faqem" simplify "$work/model.glb" "$work/webp.glb" --ratio 0.2 --texture-size 256 --image-format webp --quiet
"$faqem" simplify "$work/webp.glb" "$work/from-webp.glb" --ratio 0.5 --quiet
"$faqem" simplify "$work/model.glb" "$work/default.glb" --ratio 0.3 --quiet
"$faqem" simplify "$work/model.glb" "$work/files.gltf" --ratio 0.2 --texture-size 256 --quiet
# Via OBJ, so that the scene graph is lost and the materials are created by the OBJ reader.
"$faqem" simplify "$work/model.glb" "$work/plain.obj" --ratio 0.5 --texture-size 256 --quiet
"$faqem" simplify "$work/plain.obj" "$work/from-obj.glb" --ratio 0.5 --texture-size 256 --quiet
node "$here/validate.js" "$modules" "$work"/*.glb "$work"/*.gltf
