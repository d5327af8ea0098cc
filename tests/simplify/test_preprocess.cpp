#include "faqem/detail/simplify/preprocess.hpp"

#include "faqem/detail/geometry/triangle.hpp"

#include <cmath>
#include <limits>

#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/message_of.hpp"

using namespace faqem;
using detail::PreprocessedMesh;
using detail::Settings;
using test::removed_face;

namespace {

PreprocessedMesh preprocess(const MeshView& mesh, double diagonal = 1, double weld = 0) {
    Settings settings;
    settings.diagonal = diagonal;
    settings.weld_distance = weld;
    return detail::preprocess(mesh, settings);
}

std::string mesh_complaint(const MeshView& mesh) {
    return testing::message_of([&] { preprocess(mesh); });
}

}  // namespace

TEST_CASE("preprocessing welds vertices at equal positions and keeps face indices") {
    // The two triangles of the square, without shared vertices.
    const TriangleMesh mesh = test::make(
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, -0.0}, {-0.0, 1, 0}, {0, 0, 0}}, {{0, 1, 2}, {5, 3, 4}});
    const PreprocessedMesh p = preprocess(mesh.view());
    CHECK(p.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(p.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(p.vertex_origin == std::vector<Index>{0, 1, 2, 4});
    CHECK(p.welded == std::vector<Index>{0, 1, 2, 2, 3, 0});
    CHECK(p.dropped_faces == 0);
}

TEST_CASE("preprocessing removes faces that become degenerate by welding") {
    const TriangleMesh mesh =
        test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e-7, 0, 0}}, {{0, 1, 2}, {0, 3, 2}});
    CHECK(preprocess(mesh.view()).dropped_faces == 0);
    const PreprocessedMesh p = preprocess(mesh.view(), 1, 1e-6);
    CHECK(p.dropped_faces == 1);
    CHECK(p.triangles == std::vector<Triangle>{{0, 1, 2}, removed_face});
    CHECK(p.positions.size() == 3);
}

TEST_CASE("duplicate faces are removed unless their winding or group differs") {
    TriangleMesh mesh = test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                   {{0, 1, 2}, {1, 2, 0}, {0, 2, 1}, {2, 0, 1}, {2, 1, 0}, {1, 1, 2}});
    const PreprocessedMesh p = preprocess(mesh.view());
    CHECK(p.triangles == std::vector<Triangle>{
                             {0, 1, 2}, removed_face, {0, 2, 1}, removed_face, removed_face, removed_face});
    CHECK(p.dropped_faces == 4);
    mesh.face_groups = {0, 1, 0, 1, 0, 0};
    CHECK(preprocess(mesh.view()).triangles ==
          std::vector<Triangle>{{0, 1, 2}, {1, 2, 0}, {0, 2, 1}, removed_face, removed_face, removed_face});
}

TEST_CASE("preprocessing centres and scales the bounding box of the referenced vertices") {
    TriangleMesh mesh = test::moved(test::scaled(test::quad(), 3), {10, 20, 30});
    mesh.positions.push_back({-1e6, 1e9, 4});
    const PreprocessedMesh p = preprocess(mesh.view(), 100);
    CHECK(p.centre == Vec3{11.5, 21.5, 30});
    CHECK(p.scale == Approx(100 / std::sqrt(18.0)));
    const auto q = p.engine_positions();
    CHECK((q[2] - q[0]).norm() == Approx(100));
    CHECK((q[2] + q[0]).norm() == Approx(0).margin(1e-12));
    CHECK(p.to_model(q[2])[0] == Approx(13));
    CHECK(p.to_model(q[2])[2] == 30);
}

TEST_CASE("preprocessing finds a valid scale for coincident vertices and for the largest coordinates") {
    const PreprocessedMesh point = preprocess(test::scaled(test::cube(), 0).view());
    CHECK(point.scale == 1);
    CHECK(point.dropped_faces == 12);
    const PreprocessedMesh huge =
        preprocess(test::moved(test::scaled(test::cube(), 1e308), {5e307, 0, 0}).view());
    CHECK(huge.centre == Vec3{1e308, 5e307, 5e307});
    CHECK(huge.scale == Approx(1 / (std::sqrt(3.0) * 1e308)));
    // The diagonal of this box exceeds the largest double.
    TriangleMesh largest = test::cube();
    for (Vec3& p : largest.positions)
        for (double& x : p)
            x = x > 0 ? std::numeric_limits<double>::max() : -std::numeric_limits<double>::max();
    for (const engine::Vector3& p : preprocess(largest.view()).engine_positions())
        CHECK(p.cwiseAbs().maxCoeff() == Approx(0.5 / std::sqrt(3.0)));
    CHECK(preprocess({}).positions.empty());
}

TEST_CASE("has_no_area finds degenerate triangles at any scale") {
    using detail::has_no_area;
    // Squared lengths overflow above 1e154, and their squares above 1e77.
    for (const double s : {1.0, 1e-30, 1e30, 1e-70, 1e70, 1e-100, 1e100, 1e-150, 1e150, 1e-290, 1e290}) {
        INFO("scale " << s);
        CHECK_FALSE(has_no_area({0, 0, 0}, {s, 0, 0}, {0, s, 0}));
        CHECK_FALSE(has_no_area({0, 0, 0}, {s, 0, 0}, {0, 1e-11 * s, 0}));
        CHECK(has_no_area({0, 0, 0}, {s, 0, 0}, {0, 1e-13 * s, 0}));
        CHECK(has_no_area({0, 0, 0}, {s, s, s}, {2 * s, 2 * s, 2 * s}));
    }
    CHECK(has_no_area({1, 2, 3}, {1, 2, 3}, {1, 2, 3}));
    CHECK(has_no_area({1, 2, 3}, {1, 2, 3}, {4, 5, 6}));
}

TEST_CASE("input errors name the element and the reason") {
    TriangleMesh mesh = test::quad();
    CHECK(mesh_complaint(mesh.view()) == "accepted");
    mesh.triangles[1][2] = 4;
    CHECK(mesh_complaint(mesh.view()) == "face 1: vertex index 4 is out of range: there are 4 vertices");
    mesh.triangles[1][2] = no_index;
    CHECK(mesh_complaint(mesh.view()) == "face 1: vertex index -1 is out of range: there are 4 vertices");
    mesh = test::quad();
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        mesh.positions[2][1] = bad;
        CHECK(mesh_complaint(mesh.view()) ==
              "vertex 2: position is not finite: " + std::string(std::isnan(bad) ? "nan" : "inf"));
    }
    mesh = test::quad();
    mesh.face_groups = {0};
    CHECK(mesh_complaint(mesh.view()) == "face_groups: needs one entry per face or none, but has 1 for 2");
    mesh.face_groups.clear();
    MeshView view = mesh.view();
    const std::vector<std::uint8_t> locks(3, 0);
    view.vertex_locks = locks;
    CHECK(mesh_complaint(view) == "vertex_locks: needs one entry per vertex or none, but has 3 for 4");
    view.vertex_locks = {};
    const std::vector<float> weights = {1, 1e7f, 1, 1};
    view.vertex_weights = weights;
    CHECK(mesh_complaint(view) == "vertex 1: weight 1e+07 is not in [1e-6, 1e6]");
    view.vertex_weights = {};
    CornerAttributes uv;
    view.attributes = &uv;
    CHECK(mesh_complaint(view) ==
          "attributes: needs width >= 1 and 3 * faces * width values, but has width 0 and 0 values");
    uv = {std::vector<float>(11), 2};
    CHECK(mesh_complaint(view) ==
          "attributes: needs width >= 1 and 3 * faces * width values, but has width 2 and 11 values");
    uv.values.resize(12);
    CHECK(mesh_complaint(view) == "accepted");
    uv.values[5] = std::numeric_limits<float>::quiet_NaN();
    CHECK(mesh_complaint(view) == "attributes, corner 2: value is not finite: nan");
}
