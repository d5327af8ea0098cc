// Simplifies a random mesh with random options. Refused input must be invalid, and results must be valid.

#include <set>

#include "faqem/simplify.hpp"
#include "faqem/surface_map.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/random_options.hpp"
#include "support/results.hpp"

using namespace faqem;
using test::same_bits;

namespace {

/// A mesh with all arrays of a MeshView.
struct Soup {
    TriangleMesh mesh;
    std::vector<std::uint8_t> locks;
    std::vector<float> weights;

    explicit Soup(fuzz::Input& in) {
        const std::uint8_t extra = in.byte();
        mesh = fuzz::mesh_of(in);
        if (extra & 1)
            for (std::size_t f = 0; f < mesh.triangles.size(); ++f) mesh.face_groups.push_back(in.below(3));
        if (extra & 2) {
            mesh.attributes.width = 2;
            for (const Triangle& t : mesh.triangles)
                for (const Index v : t)
                    for (const std::size_t axis : {0, 1})
                        mesh.attributes.values.push_back(static_cast<float>(
                            extra & 4 ? in.real() : std::clamp(mesh.positions[v][axis], -1e6, 1e6)));
        }
        if (extra & 8)
            for (std::size_t v = 0; v < mesh.positions.size(); ++v) locks.push_back(in.byte() < 32);
        if (extra & 16)
            for (std::size_t v = 0; v < mesh.positions.size(); ++v)
                weights.push_back(extra & 32 ? static_cast<float>(in.real()) : 1 + in.byte());
        if (extra & 64) mesh.triangles.push_back({0, in.raw<Index>(), 0});
    }

    MeshView view() const {
        MeshView view = mesh.view();
        view.vertex_locks = locks;
        view.vertex_weights = weights;
        return view;
    }

    bool is_valid() const {
        const auto& uvs = mesh.attributes.values;
        const auto in_range = [](float w) { return w >= 1e-6f && w <= 1e6f; };
        const auto good_face = [&](const Triangle& t) {
            return std::all_of(t.begin(), t.end(), [&](Index v) { return v < mesh.positions.size(); });
        };
        return std::all_of(mesh.positions.begin(), mesh.positions.end(), fuzz::is_finite) &&
               std::all_of(mesh.triangles.begin(), mesh.triangles.end(), good_face) &&
               std::all_of(uvs.begin(), uvs.end(), [](float x) { return std::isfinite(x); }) &&
               uvs.size() == std::size_t{3} * mesh.attributes.width * mesh.triangles.size() &&
               (mesh.face_groups.empty() || mesh.face_groups.size() == mesh.triangles.size()) &&
               std::all_of(weights.begin(), weights.end(), in_range);
    }
};

// Whether every edge has two faces of opposite direction. Faces that were dropped do not count.
bool is_closed(const std::vector<Triangle>& triangles) {
    std::set<std::pair<Index, Index>> sides;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] != no_index && !sides.insert({t[k], t[(k + 1) % 3]}).second) return false;
        }
    }
    return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
        return sides.contains({side.second, side.first});
    });
}

void expect_sound(const TriangleMesh& mesh, const SimplifyResult& result) {
    const TriangleMesh& simplified = result.mesh;
    for (const Vec3& p : simplified.positions) fuzz::expect(fuzz::is_finite(p), "finite positions");
    for (const Triangle& t : simplified.triangles) {
        for (const Index v : t) fuzz::expect(v < simplified.positions.size(), "indices in range");
        fuzz::expect(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "three distinct corners");
    }
    fuzz::expect(result.face_origin.size() == simplified.triangles.size(), "an origin for every face");
    fuzz::expect(result.vertex_origin.size() == simplified.positions.size(), "an origin for every vertex");
    for (const Index f : result.face_origin) fuzz::expect(f < mesh.triangles.size(), "face origins in range");
    for (const Index v : result.vertex_origin)
        fuzz::expect(v < mesh.positions.size(), "vertex origins in range");
    const Report& report = result.report;
    fuzz::expect(report.faces_out == simplified.triangles.size(), "the correct face count in the report");
    fuzz::expect(report.faces_out <= report.target_faces || report.stop != StopReason::reached_target,
                 "the target reached, or another stop reason");
    fuzz::expect(!report.max_error || !(report.max_error->bound < report.max_error->value),
                 "a bound that is not below the value");
    const bool is_published = report.preset == Preset::paper || report.preset == Preset::stmw;
    if (is_closed(result.history.triangles) && !is_published && report.faces_dropped == 0)
        fuzz::expect(is_closed(simplified.triangles), "closed surfaces stay closed");
    validate(result.history);
    const TriangleMesh again = replay(result.history);
    fuzz::expect(same_bits(again.positions, simplified.positions) && again.triangles == simplified.triangles,
                 "replaying the history gives the result");
}

void expect_map(const CollapseHistory& history) {
    const SurfaceMap map(history);
    for (Index f = 0; f < history.remaining_faces.size(); ++f) {
        const SurfacePoint at = map.map(f, {0.25, 0.25, 0.5});
        fuzz::expect(at.face < history.triangles.size() && fuzz::is_finite(at.barycentric),
                     "a point on the original");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    fuzz::Input in(fuzz::Bytes(data, size));
    Options options = fuzz::options_of(in);
    const Soup soup(in);
    try {
        const SimplifyResult result = simplify(soup.view(), options);
        fuzz::expect(soup.is_valid(), "an error for an invalid mesh");
        expect_sound(soup.mesh, result);
        expect_map(result.history);
        if (data[size - 1] % 4 != 0) return 0;
        options.threads = 3;
        const SimplifyResult same = simplify(soup.view(), options);
        fuzz::expect(same_bits(same.mesh.positions, result.mesh.positions) &&
                         same.mesh.triangles == result.mesh.triangles,
                     "the same result with three threads");
    } catch (const InputError& error) {
        if (soup.is_valid()) std::fprintf(stderr, "%s\n", error.what());
        fuzz::expect(!soup.is_valid(), "no error for a valid mesh");
    } catch (const OptionError&) {
    }
    return 0;
}
