#!/bin/sh
# Tries faqem on an empty Debian system: the quickstart, the programs of tests/consumer against an installed faqem, each
# with the packages of its component only, and faqem as a subproject.
# Usage: tests/run.sh --suite fresh [--release bookworm|trixie] [--source FOLDER]
# The systems are folders made by debootstrap. Mirror, proxy, keys and name resolution are those of this machine, and
# the compiler cache is shared with it. Needs root, network and the right to mount; the suite is skipped otherwise.
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

skip() {
    echo "skipped: the suite fresh needs $1"
    exit 0
}
[ "$(id -u)" -eq 0 ] || skip "root"
command -v apt-get >/dev/null || skip "a Debian system (apt-get)"
"$here/../../cmake/install-packages.sh" fresh || skip "the package debootstrap"
unshare --mount --pid --fork true 2>/dev/null || skip "the right to mount file systems"
mirror=$(. /etc/os-release && apt-get indextargets --format '$(ORIGIN) $(CODENAME) $(REPO_URI)' 'Created-By: Packages' |
    sed -n "s/^Debian $VERSION_CODENAME //p" | head -n 1)
mirror=${mirror%/}
[ -n "$mirror" ] || skip "a Debian mirror in apt's sources"
for scheme in http https; do
    proxy=""
    eval "$(apt-config shell proxy "Acquire::$scheme::Proxy")"
    [ -z "$proxy" ] || export "${scheme}_proxy=$proxy"
done
wget -q -O /dev/null "$mirror/dists/$release/InRelease" || skip "the mirror $mirror with $release"

# Mounts are made in a mount namespace of each command, so that none is left when the command ends or is killed.
work=$(mktemp -d "${TMPDIR:-/tmp}/faqem-fresh.XXXXXX")
remove_work() {
    if grep -qF " $work/" /proc/self/mountinfo; then
        echo "$work is kept, because file systems are mounted below it" >&2
    else
        rm -rf --one-file-system "$work"
    fi
}
trap remove_work EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

cache=${CCACHE_DIR:-$(ccache --get-config cache_dir 2>/dev/null || echo "$work/ccache")}
mkdir -p "$cache"

# in_root ROOT COMMAND...: runs a command in a root, in its folder /root.
in_root() {
    root=$1
    shift
    unshare --mount --pid --fork --kill-child sh -c '
        root=$1 cache=$2
        shift 2
        mkdir -p "$root/ccache"
        mount -t proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        mount --bind "$cache" "$root/ccache"
        exec chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 CCACHE_DIR=/ccache \
            CCACHE_BASEDIR=/root/faqem CCACHE_NOHASHDIR=1 DEBIAN_FRONTEND=noninteractive \
            ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
            sh -eu -c "cd /root; $*"' sh "$root" "$cache" "$@"
}

# step NAME FUNCTION ARGUMENT...: runs a function, and prints the end of its output if it fails.
failed=""
step() {
    name=$1 start=$(date +%s)
    shift
    set +e  # errors inside a condition would not end the function
    (set -eu; "$@") >"$work/log" 2>&1 </dev/null
    status=$?
    set -e
    if [ $status -eq 0 ]; then
        echo "ok      $name ($(($(date +%s) - start)) s)"
    else
        echo "FAILED  $name ($(($(date +%s) - start)) s); the end of its output:"
        tail -n 30 "$work/log" | sed 's/^/    /'
        failed="$failed
    $name"
    fi
}

install_in() { in_root "$work/$1" "apt-get install -y -qq --no-install-recommends $2"; }

make_root() {
    debootstrap --variant=minbase "$release" "$work/minimal" "$mirror"
    cp /etc/resolv.conf /etc/hosts "$work/minimal/etc/"
    apt-config dump | grep -E '^Acquire::(https?|ftp|Check-[A-Za-z-]+)(::[^ ]+)? "[^"]+";$' \
        >"$work/minimal/etc/apt/apt.conf.d/00host" || true
    cp -n /etc/apt/trusted.gpg.d/* "$work/minimal/etc/apt/trusted.gpg.d/" 2>/dev/null || true
    printf '#!/bin/sh\nexit 101\n' >"$work/minimal/usr/sbin/policy-rc.d"
    chmod +x "$work/minimal/usr/sbin/policy-rc.d"
    in_root "$work/minimal" "apt-get update -qq"
    install_in minimal ccache
    mkdir "$work/minimal/root/faqem"
    cd "$source"
    if git rev-parse --git-dir >/dev/null 2>&1; then
        git ls-files -z -co --exclude-standard
    else
        find . -path ./build -prune -o -type f -print0
    fi | tar --null --files-from=- --ignore-failed-read -c | tar -x -C "$work/minimal/root/faqem" --no-same-owner
}

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
    bookworm) runtime="libtinygltf2d libdraco7 libmeshoptimizer2d libpng16-16" ;;
    trixie) runtime="libtinygltf6d libdraco8 libmeshoptimizer2d libpng16-16t64" ;;
esac
runtime="$runtime libjpeg62-turbo libwebp7 libwebpdemux2 libdeflate0"
# Stops if a step failed.
end() {
    [ -z "$failed" ] || { echo "failed:$failed"; exit 1; }
}
echo "fresh: Debian $release from $mirror"
step "an empty root" make_root
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
    "libpng-dev libjpeg62-turbo-dev libwebp-dev libdeflate-dev libtinygltf-dev libdraco-dev libmeshoptimizer-dev"
step "arrays, component header_only" consumer arrays_header_only libeigen3-dev
step "halfedges, component openmesh_header_only" consumer halfedges_header_only "libopenmesh-dev libeigen3-dev"
step "faqem::faqem by add_subdirectory" subproject
end
