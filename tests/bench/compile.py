"""How long the compiler takes for each door: CPU seconds of a file that includes it and nothing else, the median of
several, and the lines that the compiler sees. Usage: compile.py [COMPILER [REPETITIONS]]"""
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
DOORS = ["mesh.hpp", "simplify.hpp", "levels.hpp", "surface_map.hpp", "forward_map.hpp", "compare.hpp", "asset.hpp",
         "bake.hpp", "faqem.hpp", "openmesh.hpp", "engine/simplify_with.hpp"]


def cpu_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    compiler = sys.argv[1] if len(sys.argv) > 1 else "c++"
    repetitions = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    flags = ["-std=c++20", "-O2", f"-I{SOURCE / 'include'}", "-isystem", "/usr/include/eigen3"]
    print("| door | CPU s | lines |\n|---|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        file, out = pathlib.Path(folder) / "door.cpp", pathlib.Path(folder) / "door.o"
        for door in DOORS:
            file.write_text(f"#include <faqem/{door}>\n", encoding="utf-8")
            seconds = statistics.median(cpu_seconds([compiler, *flags, "-c", file, "-o", out]) for _ in range(repetitions))
            seen = subprocess.run([compiler, *flags, "-E", "-P", file], check=True, capture_output=True).stdout
            print(f"| `faqem/{door}` | {seconds:.2f} | {len(seen.splitlines())} |", flush=True)


main()
