"""Checks the source tree: includes follow the order of the folders, and files and folders have a reasonable size.

Usage: check_layout.py SOURCE

docs/architecture.md describes the order. The checks:
  * a file includes only files of its own folder, or of folders that come before it in ORDER;
  * the readers and writers of the formats are included in src/asset only (OF_PART);
  * a private include names its folder;
  * public headers include neither the engine nor libraries, except for the bodies at the end of a header;
  * the engine includes no public header but plain data, and no library but Eigen;
  * a folder has at most 20 subjects (x.hpp, x.cpp and x-inl.hpp are one);
  * a file has at most 450 lines, and a subject of src or detail at least 40, unless it is in SMALL;
  * every folder in ORDER exists, and every folder with sources is in ORDER;
  * no two types at namespace scope have the same name.
"""
import collections
import pathlib
import re
import sys

# From the bottom to the top. Folders on one line do not include each other.
ORDER = [
    ["include/faqem"],
    ["include/faqem/engine/util"],
    ["include/faqem/engine/mesh"],
    ["include/faqem/engine/quadric", "include/faqem/engine/queue"],
    ["include/faqem/engine/constraints"],
    ["include/faqem/engine/metric"],
    ["include/faqem/engine/tracking"],
    ["include/faqem/engine"],
    ["include/faqem/detail/base"],
    ["include/faqem/detail/geometry", "include/faqem/detail/options"],
    ["include/faqem/detail/measure", "include/faqem/detail/fitting", "include/faqem/detail/history",
     "include/faqem/detail/rounds"],
    ["include/faqem/detail/simplify", "include/faqem/detail/mapping"],
    ["include/faqem/detail/lod"],
    ["src/faqem"],
    ["src/asset/text", "src/asset/io", "src/asset/image"],
    ["src/asset/scene"],
    ["src/asset/formats", "src/asset/gltf"],
    ["src/asset/gltf/read", "src/asset/gltf/write"],
    ["src/asset"],
    ["src/image_plugin", "src/ktx2_plugin"],
    ["src/render"],
    ["src/scene"],
    ["src/scene/weights"],
    ["src/scene/parts"],
    ["src/bake/atlas", "src/bake/source"],
    ["src/bake/parts"],
    ["src/bake/page"],
    ["src/bake/texture"],
    ["src/bake/keep"],
    ["src/bake/scene"],
    ["src/bake/onto"],
    ["src/result"],
    ["src/capi"],
    ["src/web"],
    ["src/python/native"],
    ["src/cli/process"],
    ["src/cli/files"],
    ["src/cli/memory"],
    ["src/cli/shell"],
    ["src/cli/options"],
    ["src/cli/batch"],
    ["src/cli/report"],
    ["src/cli/commands"],
]
# Folders whose files, and those below, only a part of the tree includes.
OF_PART = {"src/asset/gltf": "src/asset", "src/asset/formats": "src/asset"}
# Public headers that the engine may include: plain data.
PLAIN = {"export.hpp", "mesh.hpp", "option_types.hpp", "options.hpp", "report.hpp", "history.hpp", "progress.hpp", "error.hpp"}
LIBRARIES = re.compile(r"Eigen|OpenMesh|OpenImageIO|png\.h|jpeglib|webp/|libdeflate|nlohmann|CLI")
MAX_SUBJECTS = 20
MAX_LINES = 450
MIN_LINES = 40
# Small subjects that stay apart: umbrellas, and what only one build uses.
SMALL = {
    # Utilities with several unrelated users.
    "include/faqem/detail/base/lower_case",
    "include/faqem/detail/base/morton",
    "include/faqem/detail/base/stopwatch",
    "include/faqem/detail/base/vector",
    "include/faqem/detail/geometry/vertex_faces",
    "include/faqem/detail/history/final_versions",
    "src/asset/image/srgb",
    "src/scene/vector_conversion",
    # Bodies and declarations of an interface.
    "include/faqem/detail/base/version",
    "include/faqem/detail/mapping/surface_map",
    "include/faqem/detail/simplify/simplify",
    "src/asset/gltf/gltf",
    "src/cli/commands/commands",
    "src/cli/commands/completion_and_profiles",
    # What the wheel replaces in other libraries.
    "src/python/native/glibc",
    "src/web/progress",                    # an import of WebAssembly
    "src/cli/report/embedded_files",       # the texts are generated at build time
}

# Definition of a type at namespace scope, which is not indented. Nested types ("struct Bvh::Range") do not count.
TYPE = re.compile(r"^(?:struct|class|enum class) (?:FAQEM_\w+ )?(?:alignas\(\d+\) )?(\w+)(?: final)?(?: :(?!:)[^;]*)? \{", re.M)


def include_lines(path):
    """Yields (text in the brackets, True if it is one of the bodies at the end of a header)."""
    bodies = False
    for line in path.read_text(encoding="utf-8").splitlines():
        if line == "#ifdef FAQEM_HEADER_ONLY":
            bodies = True
        match = re.match(r'\s*#\s*include\s*[<"]([^">]+)[">]', line)
        if match:
            yield match.group(1), bodies


def main():
    source = pathlib.Path(sys.argv[1])
    rank = {folder: number for number, folders in enumerate(ORDER) for folder in folders}
    problems = []
    subjects = collections.defaultdict(lambda: collections.defaultdict(int))
    types = collections.defaultdict(set)
    files = [path for root in ("include", "src") for path in sorted((source / root).rglob("*"))
             if path.suffix in (".hpp", ".cpp", ".h")]
    for path in files:
        name = path.relative_to(source).as_posix()
        folder = path.parent.relative_to(source).as_posix()
        if folder not in rank:
            problems.append(f"{name}: the folder {folder} is not in the order of tests/layout/check_layout.py")
            continue
        text = path.read_text(encoding="utf-8")
        for type_name in TYPE.findall(text):
            types[type_name].add(name)
        lines = len(text.splitlines())
        subjects[folder][re.sub(r"(-inl)?\.[a-z]+$", "", path.name)] += lines
        if lines > MAX_LINES:
            problems.append(f"{name}: {lines} lines, more than {MAX_LINES}")
        for included, is_body in include_lines(path):
            target = next((root / included for root in (source / "include", source / "src")
                           if (root / included).is_file()), None)
            if target is None:
                if not (source / folder / included).is_file():
                    if folder.startswith("include/faqem/engine") and LIBRARIES.search(included) and \
                            not included.startswith("Eigen"):
                        problems.append(f"{name} includes {included}: the engine may use Eigen only")
                    if folder == "include/faqem" and LIBRARIES.search(included) and path.name not in ("eigen.hpp", "openmesh.hpp"):
                        problems.append(f"{name} includes {included}: public headers use only the standard library")
                else:
                    problems.append(f"{name} includes {included} without its folder")
                continue
            below = target.parent.relative_to(source).as_posix()
            for private, part in OF_PART.items():
                if f"{below}/".startswith(f"{private}/") and not f"{folder}/".startswith(f"{part}/"):
                    problems.append(f"{name} includes {included}: only {part} may")
            if folder == "include/faqem" and not is_body and below != folder and path.name != "openmesh.hpp":
                problems.append(f"{name} includes {included}: public headers include public headers only")
            if folder.startswith("include/faqem/engine") and below == "include/faqem" and target.name not in PLAIN:
                problems.append(f"{name} includes {included}: of the public headers the engine may include plain data only")
            if is_body or below == folder or folder == "include/faqem":
                continue
            if below in rank and not rank[below] < rank[folder]:
                problems.append(f"{name} includes {included}: {below} does not come before {folder}")
    for type_name, names in types.items():
        if len(names) > 1:
            problems.append(f"the type {type_name} is defined in {' and '.join(sorted(names))}")
    for folder in rank:
        if folder not in subjects:
            problems.append(f"{folder} is in the order and has no sources")
    for folder, sizes in subjects.items():
        if len(sizes) > MAX_SUBJECTS and folder != "include/faqem":
            problems.append(f"{folder} has {len(sizes)} subjects, more than {MAX_SUBJECTS}")
        for subject, lines in sizes.items():
            is_private = folder.startswith(("src/", "include/faqem/detail/")) and folder != "src/faqem"
            if is_private and lines < MIN_LINES and f"{folder}/{subject}" not in SMALL:
                problems.append(f"{folder}/{subject}: {lines} lines are too few for a subject of its own")
    print("\n".join(problems) if problems else f"{len(files)} files in {len(subjects)} folders follow the rules")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
