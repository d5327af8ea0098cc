"""Measures the compile time of the public headers: the median CPU time for a file that includes only one of them, and
the number of lines after preprocessing. Then that of a program that simplifies a mesh, in both build modes and with
the decimation of OpenMesh and CGAL if these are installed (libopenmesh-dev, libcgal-dev), and its size without
symbols. Needs build/release. Usage: compile.py [COMPILER [REPETITIONS]]"""
import pathlib
import statistics
import subprocess
import sys
import tempfile

from results import run

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HEADERS = ["mesh.hpp", "simplify.hpp", "levels.hpp", "surface_map.hpp", "forward_map.hpp", "compare.hpp", "asset.hpp",
           "bake.hpp", "faqem.hpp", "openmesh.hpp", "engine/simplify_with.hpp"]


def measure_program(compiler, flags, source, libraries, folder):
    """Returns the CPU time to compile and link a program of tests/bench/compile, and its size in bytes."""
    out = pathlib.Path(folder) / "program"
    _, seconds = run(compiler, *flags, SOURCE / "tests/bench/compile" / source, "-o", out, *libraries, check=True,
                     capture_output=False)
    subprocess.run(["strip", out], check=True)
    return seconds, out.stat().st_size


def main():
    compiler = sys.argv[1] if len(sys.argv) > 1 else "c++"
    repetitions = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    flags = ["-std=c++20", "-O2", f"-I{SOURCE / 'include'}", "-isystem", "/usr/include/eigen3"]
    print("| header | CPU s | lines |\n|---|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        file, out = pathlib.Path(folder) / "header.cpp", pathlib.Path(folder) / "header.o"
        for header in HEADERS:
            file.write_text(f"#include <faqem/{header}>\n", encoding="utf-8")
            seconds = statistics.median(run(compiler, *flags, "-c", file, "-o", out, check=True, capture_output=False)[1]
                                        for _ in range(repetitions))
            preprocessed = subprocess.run([compiler, *flags, "-E", "-P", file], check=True, capture_output=True).stdout
            print(f"| `faqem/{header}` | {seconds:.2f} | {len(preprocessed.splitlines())} |", flush=True)
        print("\n| program | CPU s | bytes |\n|---|---:|---:|")
        library = SOURCE / "build/release/src/faqem/libfaqem.a"
        for name, source, options, libraries in [
            ("faqem, compiled", "faqem.cpp", [], [library, "-pthread"]),
            ("faqem, header-only", "faqem.cpp", ["-DFAQEM_HEADER_ONLY", "-ffp-contract=off"], ["-pthread"]),
            ("OpenMesh", "openmesh.cpp", [], ["-lOpenMeshTools", "-lOpenMeshCore"]),
            ("CGAL", "cgal.cpp", [], ["-lgmp", "-lmpfr"]),
        ]:
            try:
                seconds, size = measure_program(compiler, flags + options, source, libraries, folder)
                print(f"| {name} | {seconds:.1f} | {size} |", flush=True)
            except subprocess.CalledProcessError:
                print(f"| {name} | not installed | |", flush=True)


main()
