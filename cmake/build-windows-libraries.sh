#!/bin/sh
# Builds the libraries that faqem needs for x86-64 Windows, as static archives, from Debian's source packages: those of
# PNG, JPEG and WebP images, libdeflate and meshoptimizer. Each is built once. Those that are headers alone are linked to:
# /usr/include also has the headers of glibc.
# Usage: build-windows-libraries.sh PREFIX
set -eu
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/include" "$1/share" "$1/lib"
prefix=$(cd "$1" && pwd)
compiler=x86_64-w64-mingw32-gcc-posix

for folder in include/eigen3 include/nlohmann include/CLI share/eigen3 share/cmake; do
    ln -sfn "/usr/$folder" "$prefix/$folder"
done
mingw=/usr/x86_64-w64-mingw32
ln -sf $mingw/include/zlib.h $mingw/include/zconf.h "$prefix/include"
ln -sf $mingw/lib/libz.a "$prefix/lib"

# fetched PACKAGE: succeeds if the library of the package has yet to be built, after fetching its source to $source.
fetched() {
    source=$prefix/source/$1
    [ ! -e "$prefix/built-$1" ] || return 1
    "$here/fetch-sources.sh" "$prefix/source" "$1"
}

# build PACKAGE OPTION...
build() {
    package=$1
    shift
    fetched "$package" || return 0
    cmake -S "$source" -B "$source/build" -G Ninja --toolchain "$here/windows.cmake" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_PREFIX_PATH="$prefix" -DBUILD_SHARED_LIBS=OFF "$@" -Wno-dev
    cmake --build "$source/build"
    cmake --install "$source/build"
    touch "$prefix/built-$package"
}

build libpng1.6 -DPNG_SHARED=OFF -DPNG_TESTS=OFF
build libjpeg-turbo -DENABLE_SHARED=OFF -DWITH_TURBOJPEG=OFF -DWITH_SIMD=OFF
build libwebp -DWEBP_BUILD_ANIM_UTILS=OFF -DWEBP_BUILD_CWEBP=OFF -DWEBP_BUILD_DWEBP=OFF -DWEBP_BUILD_GIF2WEBP=OFF \
    -DWEBP_BUILD_IMG2WEBP=OFF -DWEBP_BUILD_VWEBP=OFF -DWEBP_BUILD_WEBPINFO=OFF -DWEBP_BUILD_WEBPMUX=OFF \
    -DWEBP_BUILD_EXTRAS=OFF
build meshoptimizer -DCMAKE_CXX_FLAGS=-ffp-contract=off
if fetched libdeflate; then
    make -C "$source" CC=$compiler AR=x86_64-w64-mingw32-gcc-ar-posix libdeflatestatic.lib
    cp "$source/libdeflatestatic.lib" "$prefix/lib/libdeflate.a"
    cp "$source/libdeflate.h" "$prefix/include"
    touch "$prefix/built-libdeflate"
fi
