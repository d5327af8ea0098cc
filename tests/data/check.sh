#!/bin/sh
# Compares data/ with what make_fixtures writes now, and simplifies each fixture to half of its faces.
# Usage: check.sh MAKE_FIXTURES FAQEM DATA WORK
set -eu
make_fixtures=$1 faqem=$2 data=$3 work=$4
rm -rf "$work"
"$make_fixtures" "$work"
count=0
for file in "$work"/*; do
    cmp "$data/$(basename "$file")" "$file"
    case $file in *.mtl) continue ;; esac
    "$faqem" simplify "$data/$(basename "$file")" "$work/simplified-$(basename "${file%.*}").glb" --ratio 0.5 --quiet
    count=$((count + 1))
done
[ "$count" -ge 4 ]
