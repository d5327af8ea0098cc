#!/bin/sh
# Installs what the benchmarks compare and measure with, and what draws their plots, from Debian 12's own packages. Uses
# sudo only when not root. Any of them may be left out: the benchmark has rows for the peers it finds.
set -eu

as_root=""
[ "$(id -u)" -eq 0 ] || as_root="sudo"
$as_root apt-get update -qq
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    libcgal-dev libeigen3-dev libmeshoptimizer-dev libvtk9-dev libopenmesh-dev libopen3d-dev libbenchmark-dev \
    python3 python3-matplotlib >/dev/null
