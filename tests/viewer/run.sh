#!/bin/sh
# Opens a page of `faqem report` as a local file in headless Chromium and tests its controls.
# Usage: run.sh FAQEM MAKE_MODEL WORK. The environment variable CHROMIUM is the browser (default: chromium).
# Exit code 77: skipped.
set -eu
faqem=$1 make_model=$2 work=$3
here=$(cd "$(dirname "$0")" && pwd)
browser=${CHROMIUM:-chromium}
for program in node "$browser"; do
    command -v "$program" >/dev/null || { echo "skipped: $program was not found"; exit 77; }
done
rm -rf "$work"
mkdir -p "$work"
"$make_model" "$work/model.glb" --faces 4000
"$faqem" simplify "$work/model.glb" "$work/simplified.glb" --ratio 0.05 --texture-size 256 --quiet
"$faqem" report "$work/model.glb" "$work/simplified.glb" -o "$work/report.html" --size 64 --views 1 --samples 2000
grep -q 'id="canvas"' "$work/report.html" || { echo "skipped: faqem was built without the viewer"; exit 77; }
node "$here/use_page.mjs" "$browser" "$work/report.html" "$work/profile"
