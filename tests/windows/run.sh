#!/bin/sh
# Builds the libraries, the C interface and the command for x86-64 Windows and runs them with Wine: the results are the
# bytes of the native build, and the tests of the C interface pass.
# Usage: tests/run.sh --suite windows
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
build=$source/build/windows
prefix=$build/prefix
[ $# -eq 0 ] || { echo "usage: tests/run.sh --suite windows" >&2; exit 2; }
"$source/cmake/install-packages.sh" test windows || { echo "skipped: the suite windows needs packages of Debian"; exit 0; }
"$source/cmake/build-windows-libraries.sh" "$prefix"
# -O1 halves the compile time, and the bytes must not depend on it.
cmake -S "$source" -B "$build" -G Ninja --toolchain "$source/cmake/windows.cmake" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10 -DFAQEM_WERROR=ON \
    -DFAQEM_BUILD_VIEWER=OFF -DFAQEM_BUILD_OPENMESH=OFF -DFAQEM_BUILD_TESTS=OFF -DFAQEM_BUILD_EXAMPLES=OFF -DFAQEM_BUILD_DOCS=OFF
cmake --build "$build" --target faqem_c faqem_cli
cmake --preset test -S "$source"
cmake --build "$source/build/test" --target results_compiled faqem_cli make_model

cd "$build"
options="-O1 -ffp-contract=off -Wall -Wextra -Werror -I$source/include -I$source/tests"
# A user's program in header-only mode.
echo "#include <faqem/faqem.hpp>" |
    x86_64-w64-mingw32-g++-posix $options -std=c++20 -DFAQEM_HEADER_ONLY -isystem "$prefix/include/eigen3" -fsyntax-only -x c++ -
x86_64-w64-mingw32-g++-posix $options -std=c++20 -static "$source"/tests/header_only/main.cpp \
    "$source"/tests/header_only/models.cpp "$source"/tests/header_only/results.cpp src/faqem/libfaqem.a -o results.exe
x86_64-w64-mingw32-gcc-posix $options -std=c11 -DFAQEM_HAS_ASSET -DFAQEM_TEST_DATA="\"$source/data\"" \
    "$source"/tests/capi/*.c src/capi/libfaqem_c.dll.a -o src/capi/test_c.exe

export WINEPREFIX="$build/wine" WINEDEBUG=-all LC_ALL=C.UTF-8
mkdir -p c
(cd c && /usr/lib/wine/wine64 ../src/capi/test_c.exe)
/usr/lib/wine/wine64 results.exe windows.bin
"$source/build/test/tests/header_only/results_compiled" native.bin
test -s native.bin
cmp native.bin windows.bin

# The command writes the same files and the same text as the native one, also with names beyond ASCII.
models="$build/Gefäße 花瓶"
rm -rf "$models"
mkdir -p "$models/native" "$models/windows"
"$source/build/test/examples/make_model" "$models/urn.glb" --faces 20000
"$source/build/test/bin/faqem" simplify --quiet --bake keep --faces 12000 "$models/urn.glb" "$models/Krüge.obj"

# run SYSTEM EXIT ARGUMENT...: runs a command, which ends with this exit code.
run() {
    case $1 in
        native) command=$source/build/test/bin/faqem ;;
        windows) command="/usr/lib/wine/wine64 $build/bin/faqem.exe" ;;
    esac
    cd "$models/$1"
    expected=$2
    shift 2
    code=0
    $command "$@" >>log.txt 2>&1 || code=$?
    [ $code = "$expected" ] || { cat log.txt; echo "windows: exit code $code of $command $*"; exit 1; }
}

for system in native windows; do
    run $system 0 simplify --quiet --ratio 0.1 --texture-size 512 ../urn.glb "urn 壺.glb"
    for time in 1 2; do
        run $system 0 simplify --quiet --force --faces 2000 --bake atlas --texture-size 256 ../Krüge.obj Krug.obj
    done
    run $system 7 simplify ../Krüge.obj Krug.obj
    run $system 2 simplify --force ../Krüge.obj ../windows/../Krüge.obj
    run $system 3 info fehlt_無.glb
    run $system 0 info --json "urn 壺.glb"
    run $system 0 compare --json ../urn.glb "urn 壺.glb"
    run $system 0 lod --quiet --levels 20%,5% --texture-size 256 ../urn.glb lod
    for file in "$source"/data/*_*.*; do
        run $system 0 simplify --quiet "$file" "$(basename "$file").ply"
    done
done
cd "$models"
diff -r -x "*.json" native windows  # the reports of levels have times
run windows 2 batch . out
grep -q "batch and list need Linux" log.txt
echo "windows: the same bytes as the native build"
