#include <set>

#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

// 40962 vertices: large enough to be split into blocks.
const TriangleMesh& large() {
    static const TriangleMesh mesh = test::shaken(test::icosphere(6), 0.001, 3);
    return mesh;
}

SimplifyResult simplified(Preset preset, std::uint32_t threads, Recording history) {
    Options options{.target = ratio(0.05), .preset = preset, .history = history, .threads = threads};
    return simplify(large().view(), options);
}

// The corners of all faces, as versions, after the last collapse of the history.
std::vector<Triangle> followed(const CollapseHistory& history) {
    std::vector<Triangle> faces = history.triangles;
    for (std::size_t k = 0; k < history.collapses.size(); ++k) {
        const auto fresh = static_cast<Index>(history.positions.size() + k);
        for (const Index f : history.patch(k)) {
            for (Index& corner : faces[f]) {
                if (corner == history.collapses[k].first || corner == history.collapses[k].second)
                    corner = fresh;
            }
        }
    }
    return faces;
}

}  // namespace

TEST_CASE("large meshes: the result depends neither on the number of threads nor on recording") {
    for (const Preset preset : {Preset::fast, Preset::balanced}) {
        const SimplifyResult one = simplified(preset, 1, Recording::off);
        CHECK(one.mesh.triangles.size() <= one.report.target_faces);
        CHECK(test::closed_manifold(one.mesh.triangles));
        CHECK(test::euler(one.mesh.triangles) == 2);
        const SimplifyResult more = simplified(preset, 3, Recording::on);
        CHECK(more.mesh.triangles == one.mesh.triangles);
        CHECK(more.mesh.positions == one.mesh.positions);
        CHECK(more.face_origin == one.face_origin);
        CHECK(more.vertex_origin == one.vertex_origin);
        CHECK(more.report.collapses == one.report.collapses);
    }
}

TEST_CASE("large meshes: replaying the history collapse by collapse gives the result") {
    const Preset preset = GENERATE(Preset::fast, Preset::balanced);
    const SimplifyResult result = simplified(preset, 0, Recording::on);
    const CollapseHistory& h = result.history;
    CHECK(h.collapses.size() == result.report.collapses);
    const std::vector<Triangle> faces = followed(h);
    std::size_t left = 0;
    for (const Triangle& t : faces) left += t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    CHECK(left == result.mesh.triangles.size());
    bool same = true;
    for (std::size_t f = 0; f < h.remaining_faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k)
            same =
                same && faces[h.remaining_faces[f]][k] == h.remaining_versions[result.mesh.triangles[f][k]];
    }
    CHECK(same);
    bool in_order = true;
    for (std::size_t k = 0; k < h.collapses.size(); ++k) {
        in_order = in_order && h.collapses[k].first < h.positions.size() + k &&
                   h.collapses[k].second < h.positions.size() + k;
    }
    CHECK(in_order);
}

TEST_CASE("large meshes: locked vertices keep their positions, and the callback can cancel") {
    Options options{.target = ratio(0.05), .preset = Preset::fast};
    TriangleMesh mesh = large();
    mesh.triangles.resize(mesh.triangles.size() - 1000);
    std::vector<std::uint8_t> locks(mesh.positions.size(), 0);
    for (std::size_t v = 0; v < locks.size(); v += 300) locks[v] = 1;
    MeshView view = mesh.view();
    view.vertex_locks = locks;
    const SimplifyResult result = simplify(view, options);
    const std::set<Vec3> left(result.mesh.positions.begin(), result.mesh.positions.end());
    std::set<Index> used;
    for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
    std::size_t missing = 0;
    for (std::size_t v = 0; v < locks.size(); v += 300)
        missing += used.count(static_cast<Index>(v)) && !left.count(mesh.positions[v]);
    CHECK(missing == 0);

    double last = 0;
    options.progress = [&](Phase, double done) {
        CHECK(done >= last);
        last = done;
        return done > 0.3 ? Continue::cancel : Continue::yes;
    };
    CHECK(simplify(view, options).report.stop == StopReason::cancelled);
    CHECK(last < 1);
}
