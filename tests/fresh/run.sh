#!/bin/sh
# Tries faqem on an empty Debian system: the quickstart, the programs of tests/consumer against an installed faqem, each
# with the packages of its component only, and faqem as a subproject.
# Usage: tests/run.sh --suite fresh [--release bookworm|trixie] [--source FOLDER]
# The systems are those of tests/support/debian_root.sh.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
release=bookworm
while [ $# -gt 0 ]; do
    case "$1=${2:-}" in
        --release=bookworm | --release=trixie) release=$2 ;;
        --source=?*) source=$(cd "$2" && pwd) ;;
        *) echo "usage: tests/run.sh --suite fresh [--release bookworm|trixie] [--source FOLDER]" >&2 && exit 2 ;;
    esac
    shift 2
done

suite=fresh
. "$here/../support/debian_root.sh"
check_release $release

quickstart() {
    cp -a "$work/minimal" "$work/tool"
    in_root "$work/tool" "faqem/examples/quickstart.sh"
    for result in before-after.png model-10.glb model-1.glb; do
        [ -s "$work/tool/root/faqem/out/$result" ]
    done
}

install_faqem() {
    in_root "$work/tool" "cmake --install faqem/build/release --prefix /opt/faqem && /opt/faqem/bin/faqem --version"
}

make_compiler_root() {
    cp -a "$work/minimal" "$work/compiler"
    install_in compiler "build-essential cmake ninja-build"
}

# consumer PROGRAM PACKAGES: builds and runs a program of tests/consumer. Without the packages the configuration must
# fail with their names.
consumer() {
    program=$1 packages=$2 folder=faqem/tests/consumer
    configure="cmake -G Ninja -S $folder -B build -DPROGRAMS=$program -DCMAKE_PREFIX_PATH=/opt/faqem"
    case $program in c) configure="cmake -G Ninja -S $folder/c -B build -DCMAKE_PREFIX_PATH=/opt/faqem" ;; esac
    rm -rf "$work/user"
    cp -a "$work/compiler" "$work/user"
    mkdir -p "$work/user/opt"
    cp -a "$work/tool/opt/faqem" "$work/user/opt/"
    if [ "$program" != c ] && [ -n "$packages" ]; then
        if in_root "$work/user" "$configure" >"$work/message" 2>&1; then
            echo "the component was found without its packages"
            exit 1
        fi
        for package in $packages; do
            grep -F "Debian package $package" "$work/message"
        done
    fi
    [ -z "$packages" ] || install_in user "$packages"
    in_root "$work/user" "$configure -DCMAKE_CXX_COMPILER_LAUNCHER=ccache && cmake --build build"
    in_root "$work/user" "ctest --test-dir build --output-on-failure --no-tests=error"
}

subproject() {
    rm -rf "$work/user"
    cp -a "$work/compiler" "$work/user"
    install_in user "libeigen3-dev nlohmann-json3-dev"
    in_root "$work/user" "cmake -G Ninja -S faqem/tests/embedding -B build -DFAQEM_SOURCE=/root/faqem \
        -DHOW=add_subdirectory -DFAQEM_BUILD_ASSET=OFF -DFAQEM_BUILD_OPENMESH=OFF \
        -DCMAKE_CXX_COMPILER_LAUNCHER=ccache"
    in_root "$work/user" "cmake --build build --target faqem_faqem embedding"
}

case $release in
    bookworm) runtime="libdraco7 libmeshoptimizer2d libpng16-16" ;;
    trixie) runtime="libdraco8 libmeshoptimizer2d libpng16-16t64" ;;
esac
runtime="$runtime libjpeg62-turbo libwebp7 libwebpdemux2 libdeflate0"
echo "fresh: Debian $release from $mirror"
step "an empty root" make_root $release minimal
end
step "the quickstart" quickstart
end
step "cmake --install" install_faqem
end
step "a root with a compiler" make_compiler_root
step "arrays, component faqem" consumer arrays ""
step "arrays in C, component c" consumer c "$runtime"
step "templates, component core" consumer templates libeigen3-dev
step "halfedges, component openmesh" consumer halfedges libopenmesh-dev
step "textured, component bake" consumer textured \
    "libpng-dev libjpeg62-turbo-dev libwebp-dev libdeflate-dev libdraco-dev libmeshoptimizer-dev"
step "arrays, component header_only" consumer arrays_header_only libeigen3-dev
step "halfedges, component openmesh_header_only" consumer halfedges_header_only "libopenmesh-dev libeigen3-dev"
step "faqem::faqem by add_subdirectory" subproject
end
