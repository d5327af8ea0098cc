#!/bin/sh
# Compares data/ with what make_fixtures writes now, and simplifies each fixture to half of its faces. Other versions of
# zlib compress an image differently: then the model and the colours of its surface must be the same.
# Usage: check.sh MAKE_FIXTURES FAQEM DATA WORK
set -eu
make_fixtures=$1 faqem=$2 data=$3 work=$4
rm -rf "$work"
"$make_fixtures" "$work"
count=0
description() {
    "$faqem" info "$1" --json | grep -vE '"(file|bytes)": '
}
for file in "$work"/*; do
    name=$(basename "$file")
    if ! cmp -s "$data/$name" "$file"; then
        echo "$name has other bytes"
        [ "$(description "$data/$name")" = "$(description "$file")" ]
        "$faqem" compare "$data/$name" "$file" --json | tr -d ' \n' | grep -qF '"colors":{"rmse":0.0,'
    fi
    case $file in *.mtl) continue ;; esac
    "$faqem" simplify "$data/$(basename "$file")" "$work/simplified-$(basename "${file%.*}").glb" --ratio 0.5 --quiet
    count=$((count + 1))
done
[ "$count" -ge 4 ]
