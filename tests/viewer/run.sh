#!/bin/sh
# run.sh FAQEM MAKE_MODEL WORK: opens a page of `faqem report` from the disk in headless Chromium and uses it.
# $CHROMIUM names another browser than `chromium`. Exit code 77: skipped.
set -eu
faqem=$1 make_model=$2 work=$3
here=$(cd "$(dirname "$0")" && pwd)
browser=${CHROMIUM:-chromium}
for program in node "$browser"; do
    command -v "$program" >/dev/null || { echo "skipped: there is no $program"; exit 77; }
done
rm -rf "$work"
mkdir -p "$work"
"$make_model" "$work/model.glb" --faces 4000
"$faqem" simplify "$work/model.glb" "$work/light.glb" --ratio 0.05 --texture-size 256 --quiet
"$faqem" report "$work/model.glb" "$work/light.glb" -o "$work/report.html" --size 64 --views 1 --samples 2000
grep -q 'id="canvas"' "$work/report.html" || { echo "skipped: this faqem was built without the viewer"; exit 77; }
node "$here/use_page.mjs" "$browser" "$work/report.html" "$work/profile"
