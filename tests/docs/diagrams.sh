#!/bin/sh
# Checks that the diagrams are identical to the output of draw.py. Usage: diagrams.sh PYTHON DIAGRAMS OUT
set -eu
python=$1 diagrams=$2 out=$3
rm -rf "$out"
mkdir -p "$out"
"$python" -B "$diagrams/draw.py" "$out"
for drawn in "$out"/*.svg; do
    cmp "$drawn" "$diagrams/$(basename "$drawn")"
done
