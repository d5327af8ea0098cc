#include "simplifier.hpp"

#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"
#include "faqem/report_json.hpp"
#include "faqem/simplify.hpp"

namespace faqem::bench {

namespace {

[[noreturn]] void refuse(std::string_view text, const char* why) {
    throw OptionError("simplifier " + std::string(text) + ": " + why);
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
        if (equals == std::string_view::npos) refuse(spec, "expected option=value");
        detail::set_option(options, detail::named_option(word.substr(0, equals)), word.substr(equals + 1),
                           detail::name_spelling);
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
