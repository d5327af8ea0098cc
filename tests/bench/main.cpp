/// \file
/// faqem-bench: simplifies the meshes of a directory with faqem's presets and the peers, and measures the
/// results.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <span>

#include "faqem/error.hpp"
#include "input.hpp"
#include "rows.hpp"

namespace {

using namespace faqem;
using namespace faqem::bench;

constexpr const char* usage = R"(Usage: faqem-bench [OPTION]...
  --models DIR        directory of .obj .ply .stl .off files; default: environment variable FAQEM_BENCH_MODELS
  --only NAME,...     only meshes whose file name contains one of these strings
  --max-faces N       skip larger meshes
  --min-faces N       skip smaller meshes
  --ratios R,...      ratios of faces to keep; default: 0.1,0.01
  --simplifiers S,... names of peers, presets (faqem-NAME) and presets with options (faqem-NAME:key=value:...),
                      or peers or presets for all of them; default: peers,presets
  --out FILE          output, JSON lines; existing rows are not measured again; default: results.jsonl
  --again             measure existing rows again; the last row of a mesh, ratio and simplifier is valid
  --samples N         samples per direction of each comparison; default: 100000
  --timeout S         limit of CPU time per simplifier, mesh and ratio, seconds; default: 300
  --memory G          limit of address space per run, GiB; default: 12
  --save DIR          save every result as DIR/MESH-RATIO-SIMPLIFIER.obj
  --list              print the names of the simplifiers of this build
)";

struct Arguments {
    std::filesystem::path models, out = "results.jsonl", save;
    std::vector<std::string> only;
    std::size_t min_faces = 0, max_faces = no_index;
    std::vector<double> ratios = {0.1, 0.01};
    std::vector<NamedSimplifier> simplifiers;
    std::uint64_t samples = 100'000;
    Limits limits;
    bool again = false;
};

std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> words;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(','));
        words.emplace_back(word);
        text.remove_prefix(std::min(text.size(), word.size() + 1));
    }
    return words;
}

template <class Number>
Number number(std::string_view text) {
    Number value = {};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        throw OptionError("'" + std::string(text) + "' is not a number");
    }
    return value;
}

void append(std::vector<NamedSimplifier>& to, std::vector<NamedSimplifier> more) {
    std::move(more.begin(), more.end(), std::back_inserter(to));
}

std::vector<NamedSimplifier> simplifiers(std::string_view list) {
    std::vector<NamedSimplifier> all;
    for (const std::string& word : split(list)) {
        if (word == "peers") {
            append(all, peers());
        } else if (word == "presets") {
            append(all, presets());
        } else {
            all.push_back(simplifier_named(word));
        }
    }
    return all;
}

std::vector<double> ratios(std::string_view list) {
    std::vector<double> all;
    for (const std::string& word : split(list)) {
        const double ratio = number<double>(word);
        if (!(ratio > 0 && ratio <= 1)) throw OptionError("--ratios: must be in (0, 1]: " + word);
        all.push_back(ratio);
    }
    return all;
}

Arguments parse(std::span<char*> words) {
    Arguments a;
    if (const char* folder = std::getenv("FAQEM_BENCH_MODELS")) a.models = folder;
    a.simplifiers = simplifiers("peers,presets");
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string_view key = words[i];
        if (key == "--again") {
            a.again = true;
            continue;
        }
        if (i + 1 == words.size()) throw OptionError(std::string(key) + ": unknown option or missing value");
        const std::string_view value = words[++i];
        if (key == "--models") {
            a.models = value;
        } else if (key == "--only") {
            a.only = split(value);
        } else if (key == "--max-faces") {
            a.max_faces = number<std::size_t>(value);
        } else if (key == "--min-faces") {
            a.min_faces = number<std::size_t>(value);
        } else if (key == "--ratios") {
            a.ratios = ratios(value);
        } else if (key == "--simplifiers") {
            a.simplifiers = simplifiers(value);
        } else if (key == "--out") {
            a.out = value;
        } else if (key == "--save") {
            a.save = value;
        } else if (key == "--samples") {
            a.samples = number<std::uint64_t>(value);
        } else if (key == "--timeout") {
            a.limits.seconds = number<unsigned>(value);
        } else if (key == "--memory") {
            a.limits.gibibytes = number<double>(value);
        } else {
            throw OptionError(std::string(key) + ": unknown option");
        }
    }
    if (a.models.empty())
        throw OptionError("no directory of meshes: use --models DIR or set FAQEM_BENCH_MODELS");
    return a;
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
    const std::set<RowKey> present = a.again ? std::set<RowKey>() : keys_in(a.out);
    if (a.out.has_parent_path()) std::filesystem::create_directories(a.out.parent_path());
    if (!a.save.empty()) std::filesystem::create_directories(a.save);
    std::ofstream out(a.out, std::ios::app);
    for (const Subject& subject : subjects(a)) {
        for (const double ratio : a.ratios) {
            for (const NamedSimplifier& s : a.simplifiers) {
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
    try {
        const std::span<char*> words(argv + 1, argv + argc);
        if (words.size() == 1 && std::string_view(words[0]) == "--help") {
            std::cout << usage;
        } else if (words.size() == 1 && std::string_view(words[0]) == "--list") {
            for (const NamedSimplifier& s : simplifiers("peers,presets")) std::cout << s.name << '\n';
        } else {
            run(parse(words));
        }
    } catch (const OptionError& e) {
        std::cerr << "faqem-bench: " << e.what() << '\n' << usage;
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "faqem-bench: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
