#!/bin/sh
# Installs the packages that building and testing faqem needs on Debian 12, and the packages given as
# arguments.
# Uses sudo unless run as root.
set -eu

packages="build-essential cmake ninja-build file pkg-config libeigen3-dev libnanoflann-dev nlohmann-json3-dev \
libopenmesh-dev libtinygltf-dev libopenimageio-dev libdraco-dev libmeshoptimizer-dev openimageio-tools libcli11-dev catch2 doxygen \
python3-numpy python3-pip python3-setuptools python3-wheel zsh $*"
# The glTF validator needs Node. A Node that was not installed from Debian's packages has its own npm, which
# conflicts with Debian's.
command -v npm >/dev/null 2>&1 || packages="$packages npm"

missing=""
for package in $packages; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing="$missing $package"
done
if [ -z "$missing" ]; then
    echo "packages: all installed"
    exit 0
fi

as_root=""
[ "$(id -u)" -eq 0 ] || as_root="sudo"
echo "packages: installing$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
