#!/bin/sh
# Installs the Debian 12 packages of the simplifiers that the benchmarks compare, and of google-benchmark and
# matplotlib. Uses sudo unless run as root. All packages are optional: the benchmarks have rows only for the
# peers that are found.
set -eu

as_root=""
[ "$(id -u)" -eq 0 ] || as_root="sudo"
$as_root apt-get update -qq
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    libcgal-dev libeigen3-dev libmeshoptimizer-dev libvtk9-dev libopenmesh-dev libopen3d-dev libbenchmark-dev \
    python3 python3-matplotlib >/dev/null
