#!/bin/sh
# Builds the geometry half and its C interface for x86-64 Windows and runs them with Wine: the results are the bytes of
# the native build, and the tests of the C interface pass.
# Usage: tests/run.sh --suite windows
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
build=$source/build/windows
prefix=$build/prefix
[ $# -eq 0 ] || { echo "usage: tests/run.sh --suite windows" >&2; exit 2; }
"$source/cmake/install-packages.sh" test windows || { echo "skipped: the suite windows needs packages of Debian"; exit 0; }
# A prefix with the libraries that are headers alone: /usr/include also has the headers of glibc.
mkdir -p "$prefix/include" "$prefix/share"
for folder in include/eigen3 include/nlohmann share/eigen3 share/cmake; do ln -sfn "/usr/$folder" "$prefix/$folder"; done
# -O1 halves the compile time, and the bytes must not depend on it.
cmake -S "$source" -B "$build" -G Ninja --toolchain "$source/cmake/windows.cmake" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DFAQEM_WERROR=ON -DFAQEM_BUILD_ASSET=OFF -DFAQEM_BUILD_OPENMESH=OFF \
    -DFAQEM_BUILD_TESTS=OFF -DFAQEM_BUILD_EXAMPLES=OFF -DFAQEM_BUILD_DOCS=OFF
cmake --build "$build" --target faqem_c
cmake --preset test -S "$source"
cmake --build "$source/build/test" --target results_compiled

cd "$build"
options="-O1 -ffp-contract=off -Wall -Wextra -Werror -I$source/include -I$source/tests"
# A user's program in header-only mode.
echo "#include <faqem/faqem.hpp>" |
    x86_64-w64-mingw32-g++-posix $options -std=c++20 -DFAQEM_HEADER_ONLY -isystem "$prefix/include/eigen3" -fsyntax-only -x c++ -
x86_64-w64-mingw32-g++-posix $options -std=c++20 -static "$source"/tests/header_only/main.cpp \
    "$source"/tests/header_only/models.cpp "$source"/tests/header_only/results.cpp src/faqem/libfaqem.a -o results.exe
c_tests=$source/tests/capi
x86_64-w64-mingw32-gcc-posix $options -std=c11 "$c_tests/main.c" "$c_tests/test_simplify.c" "$c_tests/test_layout.c" \
    "$c_tests/test_options.c" "$c_tests/test_levels.c" src/capi/libfaqem_c.dll.a -o src/capi/test_c.exe

export WINEPREFIX="$build/wine" WINEDEBUG=-all
/usr/lib/wine/wine64 src/capi/test_c.exe
/usr/lib/wine/wine64 results.exe windows.bin
"$source/build/test/tests/header_only/results_compiled" native.bin
test -s native.bin
cmp native.bin windows.bin
echo "windows: the same bytes as the native build"
