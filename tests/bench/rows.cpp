#include "rows.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "measure.hpp"

namespace faqem::bench {

namespace {

using nlohmann::json;

json connectivity(const TriangleMesh& mesh) {
    const MeshInfo i = info(mesh.view());
    return {{"faces", mesh.triangles.size()},
            {"vertices", i.vertices},
            {"components", i.components},
            {"boundary_edges", i.boundary_edges},
            {"nonmanifold_edges", i.nonmanifold_edges},
            {"euler", i.euler},
            {"flat_faces", flat_faces(mesh)},
            {"foldovers", foldovers(mesh)}};
}

/// Adds distances relative to the diagonal of the original, and mean squared distances relative to its
/// square.
void add_distances(json& row, const TriangleMesh& original, const TriangleMesh& result,
                   std::uint64_t samples) {
    const Comparison c = compare(original.view(), result.view(), {.samples = samples});
    const double d = c.diagonal;
    row["hausdorff"] = c.hausdorff / d;
    row["hausdorff_there"] = c.a_to_b.max / d;
    row["hausdorff_back"] = c.b_to_a.max / d;
    row["chamfer"] = c.chamfer / (d * d);
    row["normal_degrees"] = c.mean_normal_degrees;
    if (const auto border = border_hausdorff(original, result, samples / 4)) {
        row["border_hausdorff"] = *border / d;
    }
}

}  // namespace

std::set<RowKey> keys_in(const std::filesystem::path& file) {
    std::set<RowKey> keys;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        const json row = json::parse(line, nullptr, false);
        if (row.is_discarded()) continue;
        keys.insert({row.at("mesh"), row.at("ratio"), row.at("simplifier")});
    }
    return keys;
}

std::string make_row(const RowKey& key, const Subject& subject, std::size_t target, const ChildResult& result,
                     std::uint64_t samples) {
    json row = {{"mesh", key.mesh}, {"ratio", key.ratio},      {"simplifier", key.simplifier},
                {"target", target}, {"status", result.status}, {"input", connectivity(subject.mesh)}};
    if (result.outcome) {
        row["seconds"] = result.seconds;
        row["cpu_seconds"] = result.cpu_seconds;
        row["core_seconds"] = result.outcome->core_seconds;
        row["peak_mebibytes"] = result.peak_mebibytes;
        row["samples"] = samples;
        if (!result.outcome->report.empty()) row["report"] = json::parse(result.outcome->report);
        const TriangleMesh& mesh = result.outcome->mesh;
        try {
            row["output"] = connectivity(mesh);
            add_distances(row, subject.mesh, mesh, samples);
        } catch (const Error& e) {
            row["status"] = std::string("unusable: ") + e.what();
        }
    }
    return row.dump();
}

}  // namespace faqem::bench
