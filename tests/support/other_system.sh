# Builds the wheel for another system and runs its files by an emulator: the results are the bytes of the native build, and
# the tests of the C interface pass. Sourced after these are set:
#   system    the suffix of the wheel's preset, and the group of packages
#   emulator  command that runs a program of this system
#   c, cxx    compilers
# Takes the options of the suite. Leaves the folder `models` with the files of the command, and the function run().
source=$(cd "$(dirname "$0")/../.." && pwd)
build=$source/build/$system
[ $# -eq 0 ] || { echo "usage: tests/run.sh --suite $system" >&2; exit 2; }
"$source/cmake/install-packages.sh" test && "$source/cmake/install-packages.sh" wheel "$system" ||
    { echo "skipped: the suite $system needs packages of Debian"; exit 0; }
[ "$system" != windows ] || "$source/cmake/build-windows-libraries.sh" "$source/build/windows-libraries"
# -O1 halves the compile time, and the bytes must not depend on it.
cmake -S "$source" -B "$build" --preset "wheel-$system" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DFAQEM_WERROR=ON
cmake --build "$build" --target faqem_c faqem_cli
cmake --preset test -S "$source"
cmake --build "$source/build/test" --target results_compiled faqem_cli make_model
rm -rf "$build/wheel"
wheel=$(python3 -B "$source/src/python/backend/faqem_backend.py" wheel "$build/wheel" --build "$build")
python3 -m zipfile -e "$wheel" "$build/wheel"
files=$build/wheel/faqem
chmod +x "$files"/faqem*

cd "$build"
options="-O1 -ffp-contract=off -Wall -Wextra -Werror -I$source/include -I$source/tests"
# A user's program in header-only mode.
echo "#include <faqem/faqem.hpp>" |
    $cxx $options -std=c++20 -DFAQEM_HEADER_ONLY -isystem /usr/include/eigen3 -fsyntax-only -x c++ -
$cxx $options -std=c++20 -static "$source"/tests/header_only/main.cpp \
    "$source"/tests/header_only/models.cpp "$source"/tests/header_only/results.cpp src/faqem/libfaqem.a -o results.exe
$c $options -std=c11 -DFAQEM_HAS_ASSET -DFAQEM_TEST_DATA="\"$source/data\"" \
    "$source"/tests/capi/*.c "$files"/libfaqem_c.* -lm -o "$files/test_c.exe"

mkdir -p written
(cd written && $emulator "$files/test_c.exe")
$emulator results.exe other.bin
"$source/build/test/tests/header_only/results_compiled" native.bin
test -s native.bin
cmp native.bin other.bin

# The command writes the same files and the same text as the native one, also with names beyond ASCII.
models="$build/Gefäße 花瓶"
rm -rf "$models"
mkdir -p "$models/native" "$models/other"
"$source/build/test/examples/make_model" "$models/urn.glb" --faces 20000
"$source/build/test/bin/faqem" simplify --quiet --bake keep --faces 12000 "$models/urn.glb" "$models/Krüge.obj"

# run native|other EXIT ARGUMENT...: runs a command, which ends with this exit code.
run() {
    case $1 in
        native) command=$source/build/test/bin/faqem ;;
        other) command="$emulator $(echo "$files"/faqem*)" ;;
    esac
    cd "$models/$1"
    expected=$2
    shift 2
    code=0
    $command "$@" >>log.txt 2>&1 || code=$?
    [ $code = "$expected" ] || { cat log.txt; echo "$system: exit code $code of $command $*"; exit 1; }
}

for place in native other; do
    run $place 0 simplify --quiet --ratio 0.1 --texture-size 512 ../urn.glb "urn 壺.glb"
    for time in 1 2; do
        run $place 0 simplify --quiet --force --faces 2000 --bake atlas --texture-size 256 ../Krüge.obj Krug.obj
    done
    run $place 7 simplify ../Krüge.obj Krug.obj
    run $place 2 simplify --force ../Krüge.obj ../other/../Krüge.obj
    run $place 3 info fehlt_無.glb
    run $place 0 info --json "urn 壺.glb"
    run $place 0 compare --json ../urn.glb "urn 壺.glb"
    run $place 0 lod --quiet --levels 20%,5% --texture-size 256 ../urn.glb lod
    for file in "$source"/data/*_*.*; do
        run $place 0 simplify --quiet "$file" "$(basename "$file").ply"
    done
done
cd "$models"
diff -r -x "*.json" native other  # the reports of levels have times
