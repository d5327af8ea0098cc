#!/bin/sh
# Builds faqem, makes a textured model of more than 200,000 faces, and simplifies it to 10% and 1% of its faces with new
# textures. Needs Debian 12 and nothing else; the results are in out/.
set -eu
cd "$(dirname "$0")/.."
build=build/release
faqem=$build/bin/faqem

echo "== install packages (with apt-get; sudo only if not root)"
cmake/install-packages.sh
echo "== build faqem (Release) in $build; the first time takes about four minutes on two cores"
cmake --preset release >/dev/null
cmake --build --preset release

mkdir -p out
echo "== generate a model: out/model.glb"
$build/examples/make_model out/model.glb
$faqem info out/model.glb

for percent in 10 1; do
    echo "== simplify to $percent%: out/model-$percent.glb"
    $faqem simplify out/model.glb out/model-$percent.glb --ratio "$(awk "BEGIN { print $percent / 100 }")" \
        --report out/report-$percent.json --force
    cat out/report-$percent.json
done

echo "== render: out/before-after.png (original, 10%, 1%)"
$faqem render out/model.glb out/model-10.glb out/model-1.glb out/before-after.png --views 3 --force

echo
echo "Done. Open out/before-after.png, or the .glb files in any glTF viewer. On a file of your own:"
echo "    $faqem simplify YOUR.glb simplified.glb --ratio 0.1"
