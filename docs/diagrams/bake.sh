#!/bin/sh
# Makes docs/bake.png with the programs of a build. Usage: docs/diagrams/bake.sh BUILD
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM
cd "$work"
"$build/examples/make_model" urn.glb
"$build/bin/faqem" simplify urn.glb urn.stl --faces 40000 --bake none --quiet
python3 "$here/remesh.py" urn.stl remesh.obj 56
"$build/bin/faqem" bake remesh.obj textured.glb --source urn.glb
"$build/bin/faqem" render urn.glb remesh.obj textured.glb "$here/../bake.png" --views 3 --size 300 --force
