#!/bin/sh
# Tests the wheel for Linux on aarch64, which a cross compiler builds, with qemu: tests/support/other_system.sh.
# Usage: tests/run.sh --suite aarch64
set -eu
system=aarch64 emulator=qemu-aarch64-static c=aarch64-linux-gnu-gcc cxx=aarch64-linux-gnu-g++
export LD_LIBRARY_PATH="$(cd "$(dirname "$0")/../.." && pwd)/build/aarch64/src/capi" LC_ALL=C.UTF-8
. "$(dirname "$0")/../support/other_system.sh"
echo "aarch64: the same bytes as the native build"
