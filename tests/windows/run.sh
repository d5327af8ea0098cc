#!/bin/sh
# Tests the wheel for x86-64 Windows, which mingw-w64 builds, with Wine: tests/support/other_system.sh.
# Usage: tests/run.sh --suite windows
set -eu
system=windows emulator=/usr/lib/wine/wine64 c=x86_64-w64-mingw32-gcc-posix cxx=x86_64-w64-mingw32-g++-posix
export WINEPREFIX="$(cd "$(dirname "$0")/../.." && pwd)/build/wine" WINEDEBUG=-all LC_ALL=C.UTF-8
. "$(dirname "$0")/../support/other_system.sh"
run other 2 batch . out
grep -q "batch and list need Linux" log.txt
echo "windows: the same bytes as the native build"
