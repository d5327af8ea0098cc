#!/bin/sh
# Builds the npm package with Debian's emscripten. Packages that are needed are installed first.
# Usage: src/web/build_package.sh FOLDER
set -eu
[ $# -eq 1 ] || { echo "usage: src/web/build_package.sh FOLDER" >&2; exit 2; }
source=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
out=$(cd "$1" && pwd)
build=$source/build/web
prefix=$build/prefix
package=$build/package
"$source/cmake/install-packages.sh" web
# A prefix with the libraries that are headers alone: /usr/include also has the headers of glibc.
mkdir -p "$prefix/include" "$prefix/share" "$package"
for folder in include/eigen3 include/nlohmann share/eigen3 share/cmake; do ln -sfn "/usr/$folder" "$prefix/$folder"; done
cmake -S "$source" -B "$build" -G Ninja --toolchain "$source/cmake/web.cmake" -DCMAKE_FIND_ROOT_PATH="$prefix" \
    -DCMAKE_UNITY_BUILD=ON -DFAQEM_WERROR=ON -DFAQEM_BUILD_TOOL=OFF -DFAQEM_BUILD_OPENMESH=OFF -DFAQEM_BUILD_C=OFF \
    -DFAQEM_BUILD_TESTS=OFF -DFAQEM_BUILD_EXAMPLES=OFF -DFAQEM_BUILD_DOCS=OFF
cmake --build "$build" --target faqem_web faqem_bake_web
cp "$source"/src/web/package/* "$build"/src/web/*.wasm "$source/LICENSE" "$package"
node "$source/src/web/pack.mjs" "$package"
cd "$package"
npm pack --silent --pack-destination "$out"
