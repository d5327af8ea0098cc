#!/bin/sh
# Installs packages on Debian 12 or 13. Usage: cmake/install-packages.sh [GROUP...]
#   build   what the libraries and the command need (the default; the next groups include it)
#   test    what tests/run.sh needs besides
#   clang   the compiler clang, for the preset clang, with the libraries of its sanitizers and libFuzzer for fuzz
#   tidy    clang-tidy and clang-format
#   docs    what the target docs needs
#   wheel   what src/python/build_wheel.sh needs, without the packages of the group build
#   aarch64 what src/python/build_wheel.sh needs besides the group wheel for a wheel for aarch64, and qemu to run it
#   engines what tests/run.sh --suite engines needs, without Slurm, which the group slurm has
#   blender what tests/run.sh --suite blender needs: shared libraries that Blender as a Python module links to
#   comfyui what tests/run.sh --suite comfyui needs
#   ktx2    what the option FAQEM_WITH_KTX2 and tests/run.sh --suite ktx2 need besides, without cargo
#   windows what tests/run.sh --suite windows needs besides
#   web     what src/web/build_package.sh and tests/run.sh --suite web need; Node 18 or newer
#   fresh   what tests/run.sh --suite fresh needs, without the packages of the group build
# Uses sudo only when not root.
set -eu

# The viewer of the command, and the glTF validator of the tests, need npm. A Node from elsewhere brings its own, which
# Debian's package conflicts with.
npm=""
command -v npm >/dev/null 2>&1 || npm=npm

packages="build-essential cmake ninja-build pkg-config libeigen3-dev nlohmann-json3-dev libopenmesh-dev \
libpng-dev libjpeg62-turbo-dev libwebp-dev libdeflate-dev libopenimageio-dev \
libdraco-dev libmeshoptimizer-dev libcli11-dev libmd-dev"
foreign=""
for group in "$@"; do
    case $group in
        build) ;;
        test)
            packages="$packages catch2 ccache doxygen file python3-numpy python3-pip chromium $npm"
            ;;
        clang) packages="$packages clang libclang-rt-dev" ;;
        tidy) packages="$packages clang clang-tidy clang-format" ;;
        docs) packages="$packages doxygen python3" ;;
        wheel)
            packages="build-essential cmake ninja-build libeigen3-dev nlohmann-json3-dev libpng-dev \
libjpeg62-turbo-dev libwebp-dev libdeflate-dev zlib1g-dev libdraco-dev libcli11-dev libmd-dev python3 $npm"
            ;;
        aarch64)
            packages="$packages g++-aarch64-linux-gnu qemu-user-static libpng-dev:arm64 libjpeg62-turbo-dev:arm64 \
libwebp-dev:arm64 libdeflate-dev:arm64 zlib1g-dev:arm64 libdraco-dev:arm64 libmd-dev:arm64"
            foreign=arm64
            ;;
        fresh) packages="debootstrap ccache" ;;
        engines | comfyui) packages="python3-venv" ;;
        blender)
            packages="python3-venv libx11-6 libxrender1 libxfixes3 libxi6 libxkbcommon0 libsm6 libgl1"
            ;;
        ktx2) packages="$packages libzstd-dev python3-venv" ;;
        windows) packages="$packages g++-mingw-w64-x86-64-posix libz-mingw-w64-dev wine64" ;;
        web)
            packages="cmake ninja-build libeigen3-dev nlohmann-json3-dev emscripten nodejs $npm"
            ;;
        slurm) packages="$packages slurm-wlm munge" ;;
        *)
            echo "cmake/install-packages.sh: there is no group '$group' (known: build, test, clang, tidy, docs, wheel, aarch64, fresh, engines, slurm, blender, comfyui, ktx2, windows, web)" >&2
            exit 2
            ;;
    esac
done

# A package counts if it is installed for the architecture that is meant, or for all.
missing=""
native=$(dpkg --print-architecture 2>/dev/null || true)
for package in $packages; do
    case $package in *:*) architecture=${package#*:} ;; *) architecture="$native|all" ;; esac
    dpkg-query -W -f='${Architecture} ${Status}\n' "$package" 2>/dev/null |
        grep -Eq "^($architecture) install ok installed$" || missing="$missing $package"
done
if [ -z "$missing" ]; then
    echo "packages: all installed"
    exit 0
fi

# fail REASON: names the packages, so that they can be installed in another way.
fail() {
    echo "cmake/install-packages.sh: $1. These packages are missing:$missing" >&2
    exit 1
}

as_root=""
if [ "$(id -u)" -ne 0 ]; then
    as_root="sudo"
    command -v sudo >/dev/null 2>&1 || fail "installing packages needs root or sudo"
fi
command -v apt-get >/dev/null 2>&1 || fail "apt-get is not available on this system"
echo "packages: installing$missing"
[ -z "$foreign" ] || $as_root dpkg --add-architecture "$foreign"
$as_root apt-get update -qq || fail "apt-get update failed; is the network reachable?"
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null ||
    fail "apt-get install failed"
