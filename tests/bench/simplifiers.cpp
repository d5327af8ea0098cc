#include "simplifier.hpp"

#include <charconv>

#include "faqem/error.hpp"
#include "faqem/report_json.hpp"
#include "faqem/simplify.hpp"

namespace faqem::bench {

namespace {

[[noreturn]] void refuse(std::string_view text, const char* why) {
    throw OptionError("simplifier " + std::string(text) + ": " + why);
}

double number(std::string_view text, std::string_view spec) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) refuse(spec, "not a number");
    return value;
}

LinkCondition link_named(std::string_view value, std::string_view spec) {
    if (value == "off") return LinkCondition::off;
    if (value == "by-size") return LinkCondition::by_size;
    if (value == "on") return LinkCondition::on;
    if (value == "strict") return LinkCondition::strict;
    refuse(spec, "link must be off, by-size, on or strict");
}

void set(Options& options, std::string_view key, std::string_view value, std::string_view spec) {
    if (key == "link") {
        options.topology.link = link_named(value, spec);
    } else if (key == "border") {
        if (value != "free" && value != "locked") refuse(spec, "border must be free or locked");
        options.topology.boundary = value == "locked" ? Boundary::locked : Boundary::free;
    } else if (key == "area") {
        options.weights.area = number(value, spec);
    } else if (key == "boundary") {
        options.weights.boundary = number(value, spec);
    } else if (key == "normal") {
        options.weights.normal = number(value, spec);
    } else if (key == "uv") {
        options.weights.uv = number(value, spec);
    } else if (key == "plane_area") {
        options.weights.plane_area = number(value, spec);
    } else if (key == "virtual") {
        options.topology.virtual_edges = VirtualEdges::on;
        options.topology.virtual_edge_distance = number(value, spec);
    } else if (key == "weld") {
        options.topology.weld_distance = number(value, spec);
    } else if (key == "threads") {
        options.threads = static_cast<std::uint32_t>(number(value, spec));
    } else {
        refuse(spec, "unknown key");
    }
}

Outcome run(const TriangleMesh& mesh, std::size_t target_faces, Options options) {
    options.target = faces(target_faces);
    SimplifyResult result = faqem::simplify(mesh.view(), options);
    return {std::move(result.mesh), result.report.seconds.simplify, to_json(result.report)};
}

NamedSimplifier faqem_named(std::string_view spec) {
    std::string_view rest = spec.substr(std::string_view("faqem-").size());
    const auto next = [&] {
        const std::string_view word = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(rest.size(), word.size() + 1));
        return word;
    };
    Options options{.preset = preset_named(next())};
    while (!rest.empty()) {
        const std::string_view word = next();
        const std::size_t equals = word.find('=');
        if (equals == std::string_view::npos) refuse(spec, "expected key=value");
        set(options, word.substr(0, equals), word.substr(equals + 1), spec);
    }
    validate(options);
    return {std::string(spec), [options](const TriangleMesh& mesh, std::size_t target_faces) {
                return run(mesh, target_faces, options);
            }};
}

}  // namespace

std::vector<NamedSimplifier> peers() {
    return {
#ifdef FAQEM_BENCH_CGAL
        {"cgal-lt", cgal_lindstrom_turk},
        {"cgal-gh", cgal_garland_heckbert},
#endif
#ifdef FAQEM_BENCH_MESHOPTIMIZER
        {"meshoptimizer", meshoptimizer},
#endif
#ifdef FAQEM_BENCH_VTK
        {"vtk", vtk},
#endif
#ifdef FAQEM_BENCH_OPENMESH
        {"openmesh", openmesh},
#endif
#ifdef FAQEM_BENCH_OPEN3D
        {"open3d", open3d},
#endif
    };
}

std::vector<NamedSimplifier> packages() {
    std::vector<NamedSimplifier> all;
    for (const char* name : {"blender", "gltfpack", "manifold3d", "meshlib"}) {
        all.push_back({name, [name](const TriangleMesh& mesh, std::size_t target_faces) {
                           return package(name, mesh, target_faces);
                       }});
    }
    return all;
}

std::vector<NamedSimplifier> presets() {
    std::vector<NamedSimplifier> all;
    for (const Preset preset : all_presets) {
        all.push_back(faqem_named("faqem-" + std::string(name(preset))));
    }
    return all;
}

NamedSimplifier simplifier_named(std::string_view text) {
    if (text.starts_with("faqem-")) return faqem_named(text);
    for (const auto& all : {peers(), packages()}) {
        for (const NamedSimplifier& peer : all) {
            if (peer.name == text) return peer;
        }
    }
    refuse(text, "unknown, or not in this build");
}

}  // namespace faqem::bench
