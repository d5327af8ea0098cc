#!/bin/sh
# Builds the npm package, installs it into an empty folder and tries it in Node and Chromium: the results are the bytes of the native
# library. Needs a build of the preset test.
# Usage: tests/run.sh --suite web
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
[ $# -eq 0 ] || { echo "usage: tests/run.sh --suite web" >&2; exit 2; }
"$source/cmake/install-packages.sh" test && "$source/cmake/install-packages.sh" web ||
    { echo "skipped: the suite web needs packages of Debian"; exit 0; }
work=$(mktemp -d "${TMPDIR:-/tmp}/faqem-web.XXXXXX")
trap 'rm -rf "$work"' EXIT INT TERM
"$source/src/web/build_package.sh" "$work"

# The Python module beside the native library, which writes the cases and their results.
mkdir "$work/faqem" "$work/cases" "$work/empty"
ln -s "$source"/src/python/faqem/*.py "$source/build/test/src/capi/libfaqem_c.so" "$work/faqem"
PYTHONPATH=$work /usr/bin/python3 -B "$here/native.py" "$work/cases" "$source"/data/*.obj "$source"/data/*.ply "$source"/data/*.stl \
    "$source"/data/*.glb
bake() { PYTHONPATH=$work /usr/bin/python3 -B "$here/baked.py" "$@"; }
mkdir "$work/cases/baked"
bake write "$work/cases/baked" "$source/data/textured_quad.glb"

cd "$work/empty"
npm install --silent --no-audit --no-fund "$work"/faqem-*.tgz typescript@5 pngjs@7 three@0.187 @gltf-transform/functions@4
for file in faqem:400000 faqem-bake:1300000; do
    size=$(gzip -9c "node_modules/faqem/${file%:*}.wasm" | wc -c)
    echo "${file%:*}.wasm: $size bytes gzipped"
    [ "$size" -le "${file#*:}" ]
done
cp -R "$here"/*.mjs "$here"/types.mts "$source"/examples/web/* .
ln -s ../cases cases
npx tsc --noEmit --strict --module nodenext --lib es2022,esnext.float16,dom types.mts
node --test-reporter=spec test_package.mjs "$work/cases"
node --test-reporter=spec test_bake.mjs "$work/cases/baked"
bake compare "$work/cases/baked"
node test_browser.mjs chromium "$work/profile" "$source/tests/viewer/browser.mjs"
bake compare "$work/cases/baked"  # with a result of Chromium
