/// \file
/// faqem-bench: simplifies the meshes of a directory with faqem's presets and the peers, and measures the
/// results.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "faqem/error.hpp"
#include "input.hpp"
#include "rows.hpp"

namespace {

using namespace faqem;
using namespace faqem::bench;

struct Arguments {
    std::filesystem::path models, out = "results.jsonl", save;
    std::vector<std::string> only;
    std::size_t min_faces = 0, max_faces = no_index;
    std::vector<double> ratios = {0.1, 0.01};
    std::vector<std::string> simplifiers = {"peers", "presets"};
    std::uint64_t samples = 100'000;
    Limits limits;
    bool again = false, list = false;
};

void append(std::vector<NamedSimplifier>& to, std::vector<NamedSimplifier> more) {
    std::move(more.begin(), more.end(), std::back_inserter(to));
}

std::vector<NamedSimplifier> simplifiers(const std::vector<std::string>& names) {
    std::vector<NamedSimplifier> all;
    for (const std::string& name : names) {
        if (name == "peers") {
            append(all, peers());
        } else if (name == "packages") {
            append(all, packages());
        } else if (name == "presets") {
            append(all, presets());
        } else {
            all.push_back(simplifier_named(name));
        }
    }
    return all;
}

void add_options(CLI::App& app, Arguments& a) {
    app.option_defaults()->always_capture_default();
    app.add_option("--models", a.models, "directory of .obj .ply .stl .off files")
        ->envname("FAQEM_BENCH_MODELS");
    app.add_option("--only", a.only, "only meshes whose file name contains one of these strings")
        ->delimiter(',');
    app.add_option("--max-faces", a.max_faces, "skip larger meshes");
    app.add_option("--min-faces", a.min_faces, "skip smaller meshes");
    app.add_option("--ratios", a.ratios, "ratios of faces to keep")
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--simplifiers", a.simplifiers,
                   "names of peers, packages, presets (faqem-NAME) and presets with options "
                   "(faqem-NAME:option=value:...), "
                   "or peers, packages or presets for all of them")
        ->delimiter(',');
    app.add_option("--out", a.out, "output, JSON lines; existing rows are not measured again");
    app.add_flag("--again", a.again,
                 "measure existing rows again; the last row of a mesh, ratio and simplifier is valid");
    app.add_option("--samples", a.samples, "samples per direction of each comparison");
    app.add_option("--timeout", a.limits.seconds,
                   "limit of CPU time per simplifier, mesh and ratio, seconds");
    app.add_option("--memory", a.limits.gibibytes, "limit of address space per run, GiB");
    app.add_option("--save", a.save, "save every result as DIR/MESH-RATIO-SIMPLIFIER.obj");
    app.add_flag("--list", a.list, "print the names of the simplifiers of this build");
}

/// Loads the selected meshes, sorted by increasing size, so that an interrupted run has as many rows as
/// possible.
std::vector<Subject> subjects(const Arguments& a) {
    std::vector<Subject> all;
    for (const std::filesystem::path& file : mesh_files(a.models)) {
        Subject s = {file.filename().string(), {}};
        const auto wanted = [&](const std::string& part) { return s.name.find(part) != std::string::npos; };
        if (!a.only.empty() && std::none_of(a.only.begin(), a.only.end(), wanted)) continue;
        s.mesh = load_welded(file);
        const std::size_t faces = s.mesh.triangles.size();
        if (faces >= std::max<std::size_t>(a.min_faces, 1) && faces <= a.max_faces) {
            all.push_back(std::move(s));
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Subject& x, const Subject& y) {
        return x.mesh.triangles.size() < y.mesh.triangles.size();
    });
    return all;
}

/// Computes the target as faqem::ratio() does. The factor compensates rounding before floor().
std::size_t target_faces(double ratio, std::size_t faces) {
    return static_cast<std::size_t>(
        std::max(4.0, std::floor(ratio * static_cast<double>(faces) * (1 + 1e-15))));
}

std::string file_name(const RowKey& key) {
    std::string ratio(32, ' ');
    ratio.erase(std::to_chars(ratio.data(), ratio.data() + ratio.size(), key.ratio).ptr - ratio.data());
    return key.mesh + "-" + ratio + "-" + key.simplifier + ".obj";
}

void run(const Arguments& a) {
    if (a.models.empty())
        throw OptionError("no directory of meshes: use --models DIR or set FAQEM_BENCH_MODELS");
    const std::vector<NamedSimplifier> measured = simplifiers(a.simplifiers);
    const std::set<RowKey> present = a.again ? std::set<RowKey>() : keys_in(a.out);
    if (a.out.has_parent_path()) std::filesystem::create_directories(a.out.parent_path());
    if (!a.save.empty()) std::filesystem::create_directories(a.save);
    std::ofstream out(a.out, std::ios::app);
    for (const Subject& subject : subjects(a)) {
        for (const double ratio : a.ratios) {
            for (const NamedSimplifier& s : measured) {
                const RowKey key = {subject.name, ratio, s.name};
                if (present.contains(key)) continue;
                const std::size_t target = target_faces(ratio, subject.mesh.triangles.size());
                const ChildResult result = run_in_child(s.simplify, subject.mesh, target, a.limits);
                out << make_row(key, subject, target, result, a.samples) << std::endl;
                if (!out) throw WriteError(a.out.string() + ": cannot write the file");
                if (!a.save.empty() && result.outcome)
                    save_obj(result.outcome->mesh, a.save / file_name(key));
                std::printf("%-40s %-6g %-32s %s %.3f s\n", key.mesh.c_str(), ratio, key.simplifier.c_str(),
                            result.status.c_str(), result.seconds);
                std::fflush(stdout);
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    Arguments a;
    CLI::App app("Simplifies meshes with faqem's presets and the peers, and measures the results.",
                 "faqem-bench");
    add_options(app, a);
    CLI11_PARSE(app, argc, argv);
    try {
        if (a.list) {
            for (const NamedSimplifier& s : simplifiers(a.simplifiers)) std::cout << s.name << '\n';
        } else {
            run(a);
        }
    } catch (const std::exception& e) {
        std::cerr << "faqem-bench: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
