// simplify() for OpenMesh meshes.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <random>

#include "faqem/openmesh.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;

// A bumpy n x n torus: closed, genus 1.
TriangleMesh torus(Index n) {
    TriangleMesh mesh = test::torus(n, n);
    for (Index v = 0; v < n * n; ++v) {
        const double a = 2 * test::pi * (v / n) / n, b = 2 * test::pi * (v % n) / n;
        for (double& x : mesh.positions[v]) x *= 1 + 0.03 * std::sin(5 * a + 3 * b);
    }
    return mesh;
}

// A height field of n x n squares of side 1 / n, with an open boundary and a hole.
TriangleMesh height_field_with_hole(Index n) {
    TriangleMesh mesh = test::square(n, 1, 0);
    for (Vec3& p : mesh.positions) p[2] = 0.1 * std::sin(7 * p[0]) * std::cos(5 * p[1]);
    const auto is_in_hole = [n](Index i) { return i > n / 3 && i < n / 2; };
    std::erase_if(mesh.triangles, [&](const Triangle& t) {  // corner 0 is the lower left one of its square
        return is_in_hole(t[0] % (n + 1)) && is_in_hole(t[0] / (n + 1));
    });
    return mesh;
}

template <class M = Mesh>
M build(const TriangleMesh& soup) {
    M mesh;
    std::vector<typename M::VertexHandle> handles;
    for (const Vec3& p : soup.positions) {
        using S = typename M::Scalar;
        handles.push_back(mesh.add_vertex(typename M::Point(S(p[0]), S(p[1]), S(p[2]))));
    }
    for (const Triangle& t : soup.triangles) mesh.add_face(handles[t[0]], handles[t[1]], handles[t[2]]);
    return mesh;
}

using Corners = std::array<Vec3, 3>;

// Corner positions of all faces, each rotated so that the smallest comes first; sorted.
std::vector<Corners> sorted_faces(std::vector<Corners> faces) {
    for (Corners& f : faces) std::rotate(f.begin(), std::ranges::min_element(f), f.end());
    std::ranges::sort(faces);
    return faces;
}

// Of every face that is not deleted.
template <class M>
std::vector<Corners> face_set(const M& mesh) {
    std::vector<Corners> faces;
    for (const auto f : mesh.faces()) {
        auto corner = faces.emplace_back().begin();
        for (const auto v : mesh.fv_range(f))
            *corner++ = {mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]};
    }
    return sorted_faces(std::move(faces));
}

std::vector<Corners> face_set(const TriangleMesh& mesh) {
    std::vector<Corners> faces;
    for (const auto [a, b, c] : mesh.triangles)
        faces.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
    return sorted_faces(std::move(faces));
}

// True if the half-edges are connected consistently. The core library of OpenMesh has no public check for
// this.
template <class M>
bool is_consistent(const M& mesh) {
    for (const auto h : mesh.halfedges()) {
        if (mesh.prev_halfedge_handle(mesh.next_halfedge_handle(h)) != h) return false;
        if (mesh.opposite_halfedge_handle(mesh.opposite_halfedge_handle(h)) != h) return false;
        if (mesh.to_vertex_handle(h) == mesh.from_vertex_handle(h)) return false;
        if (mesh.is_boundary(h) && mesh.is_boundary(mesh.opposite_halfedge_handle(h))) return false;
    }
    return true;
}

// The faces of the result for arrays, with the rules for half-edge meshes.
std::vector<Corners> faces_of_arrays(const MeshView& arrays, Options options) {
    options.topology.link = LinkCondition::strict;
    options.topology.weld = Weld::none;
    return face_set(simplify(arrays, options).mesh);
}

}  // namespace

TEST_CASE("simplifying a manifold OpenMesh mesh gives the same faces as simplifying its arrays") {
    const TriangleMesh soup = GENERATE(torus(40), height_field_with_hole(40));
    const auto preset =
        GENERATE(Preset::qem, Preset::paper, Preset::stmw, Preset::fast, Preset::balanced, Preset::best);
    const double share = GENERATE(0.5, 0.1, 0.01);
    Options options{.target = ratio(share), .preset = preset};
    Mesh mesh = build(soup);
    const Report report = simplify(mesh, options);
    CHECK(face_set(mesh) == faces_of_arrays(soup.view(), options));
    CHECK(is_consistent(mesh));
    CHECK(report.faces_out == face_set(mesh).size());
    CHECK(report.faces_out < soup.triangles.size());
}

TEST_CASE("preset best flips the same edges of an OpenMesh mesh as of its arrays") {
    TriangleMesh soup = torus(40);
    for (std::size_t v = 0; v < soup.positions.size(); ++v) {
        for (std::size_t k = 0; k < 3; ++k) soup.positions[v][k] += 0.02 * std::sin(double(v * (3 * k + 7)));
    }
    Options options{.target = ratio(0.1), .preset = Preset::best};
    Mesh mesh = build(soup);
    const Report report = simplify(mesh, options);
    CHECK(report.edges_flipped > 0);
    CHECK(face_set(mesh) == faces_of_arrays(soup.view(), options));
    CHECK(is_consistent(mesh));
}

TEST_CASE("max_error gives the same result for an OpenMesh mesh as for its arrays") {
    const TriangleMesh soup = torus(32);
    Options options{.max_error = of_diagonal(0.01)};
    Mesh mesh = build(soup);
    const Report report = simplify(mesh, options);
    REQUIRE(report.max_error);
    CHECK(report.max_error->within());
    CHECK(report.stop == StopReason::reached_max_error);
    CHECK(report.faces_out < soup.triangles.size() / 2);
    CHECK(face_set(mesh) == faces_of_arrays(soup.view(), options));
    CHECK(is_consistent(mesh));
}

TEST_CASE("a closed OpenMesh torus stays a closed torus") {
    Mesh mesh = build(torus(48));
    const Report report = simplify(mesh, {.target = ratio(0.02), .preset = Preset::qem});
    CHECK(report.stop == StopReason::reached_target);
    mesh.garbage_collection();
    CHECK(mesh.n_faces() == report.faces_out);
    CHECK(static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) +
              static_cast<int>(mesh.n_faces()) ==
          0);
    for (const auto e : mesh.edges()) REQUIRE_FALSE(mesh.is_boundary(e));
}

TEST_CASE("handles and custom properties of remaining elements stay valid") {
    const TriangleMesh soup = torus(30);
    Mesh mesh = build(soup);
    OpenMesh::VPropHandleT<int> vertex_number;
    OpenMesh::FPropHandleT<int> face_number;
    mesh.add_property(vertex_number);
    mesh.add_property(face_number);
    for (const auto v : mesh.vertices()) mesh.property(vertex_number, v) = v.idx() * 7;
    for (const auto f : mesh.faces()) mesh.property(face_number, f) = f.idx() * 3;
    simplify(mesh, {.target = ratio(0.2)});
    std::size_t living = 0;
    for (const auto v : mesh.vertices()) {
        REQUIRE(mesh.property(vertex_number, v) == v.idx() * 7);
        ++living;
    }
    for (const auto f : mesh.faces()) REQUIRE(mesh.property(face_number, f) == f.idx() * 3);
    CHECK(living < soup.positions.size() / 3);
}

TEST_CASE("locked and feature elements do not move") {
    const TriangleMesh soup = height_field_with_hole(24);
    Mesh mesh = build(soup);
    mesh.request_vertex_status();
    mesh.request_edge_status();
    std::vector<std::pair<Mesh::VertexHandle, Mesh::Point>> kept;
    for (const auto v : mesh.vertices()) {
        if (v.idx() % 17 == 0 && mesh.valence(v) > 0) {
            mesh.status(v).set_locked(true);
            kept.emplace_back(v, mesh.point(v));
        }
    }
    const Mesh::EdgeHandle feature(100);
    mesh.status(feature).set_feature(true);
    for (const int side : {0, 1}) {
        const auto v = mesh.to_vertex_handle(mesh.halfedge_handle(feature, side));
        kept.emplace_back(v, mesh.point(v));
    }
    simplify(mesh, {.target = ratio(0.1)});
    for (const auto& [v, p] : kept) {
        REQUIRE_FALSE(mesh.status(v).deleted());
        CHECK(mesh.point(v) == p);
    }
}

TEST_CASE("faces outside the selected region are not deleted") {
    const TriangleMesh soup = height_field_with_hole(24);
    Mesh mesh = build(soup);
    mesh.request_face_status();
    for (const auto f : mesh.faces()) mesh.status(f).set_selected(mesh.calc_face_centroid(f)[0] < 0.5);
    std::vector<Mesh::FaceHandle> outside;
    for (const auto f : mesh.faces()) {
        if (!mesh.status(f).selected()) outside.push_back(f);
    }
    simplify(mesh, {.target = faces(4)}, Region::selected_faces);
    std::size_t living = 0;
    for (const auto f : mesh.faces()) living += f.is_valid();
    for (const auto f : outside) REQUIRE_FALSE(mesh.status(f).deleted());
    CHECK(living < soup.triangles.size() * 6 / 10);
}

TEST_CASE("weights and groups from properties give the same result as weights and groups in arrays") {
    const TriangleMesh soup = torus(40);
    Mesh mesh = build(soup);
    Properties properties;
    mesh.add_property(properties.weight);
    mesh.add_property(properties.group);
    std::vector<float> weights;
    std::vector<Index> groups;
    for (const auto v : mesh.vertices()) {
        weights.push_back(mesh.point(v)[0] > 0 ? 10 : 1);
        mesh.property(properties.weight, v) = weights.back();
    }
    for (const auto f : mesh.faces()) {
        groups.push_back(mesh.calc_face_centroid(f)[1] > 0);
        mesh.property(properties.group, f) = groups.back();
    }
    Options options{.target = ratio(0.1)};
    options.topology.group_boundaries = GroupBoundaries::preserved;
    const Report report = simplify(mesh, options, Region::all, properties);
    CHECK(report.faces_out <= report.target_faces);
    MeshView view{soup.positions, soup.triangles, groups};
    view.vertex_weights = weights;
    CHECK(face_set(mesh) == faces_of_arrays(view, options));
    CHECK(is_consistent(mesh));
    view.face_groups = {};
    CHECK(face_set(mesh) != faces_of_arrays(view, options));
    unsigned important = 0;
    for (const auto f : mesh.faces()) important += mesh.calc_face_centroid(f)[0] > 0;
    CHECK(important > 0.6 * double(mesh.n_faces() - (soup.triangles.size() - report.faces_out)));
}

TEST_CASE("small components of an OpenMesh mesh are pruned even at ratio 1") {
    TriangleMesh soup = torus(20);
    const auto first = static_cast<Index>(soup.positions.size());
    soup = test::both(soup, test::make({{9, 0, 0}, {9.1, 0, 0}, {9, 0.1, 0}}, {{0, 1, 2}}));
    const double share = GENERATE(1.0, 0.3);
    Options options{.target = ratio(share)};
    options.topology.prune = model_units(0.2);
    Mesh mesh = build(soup);
    const Report report = simplify(mesh, options);
    CHECK(report.components_pruned == 1);
    CHECK(report.faces_pruned == 1);
    CHECK(mesh.status(mesh.face_handle(800)).deleted());
    CHECK(mesh.status(mesh.vertex_handle(static_cast<int>(first))).deleted());
    CHECK(is_consistent(mesh));
    mesh.garbage_collection();
    CHECK(mesh.n_faces() == report.faces_out);
}

TEST_CASE("a float mesh with deleted faces can be simplified twice") {
    FloatMesh mesh = build<FloatMesh>(torus(30));
    mesh.request_face_status();
    mesh.request_edge_status();
    mesh.request_vertex_status();
    mesh.delete_face(FloatMesh::FaceHandle(5), true);
    const Report first = simplify(mesh, {.target = ratio(0.5)});
    CHECK(first.faces_in == 2 * 30 * 30 - 1);
    const Report second = simplify(mesh, {.target = faces(100)});
    CHECK(second.faces_in == first.faces_out);
    CHECK(second.faces_out <= 100);
    CHECK(is_consistent(mesh));
}

TEST_CASE("a locked boundary keeps the positions of its vertices") {
    Mesh mesh = build(height_field_with_hole(20));
    std::vector<std::pair<Mesh::VertexHandle, Mesh::Point>> border;
    for (const auto v : mesh.vertices()) {
        if (mesh.valence(v) > 0 && mesh.is_boundary(v)) border.emplace_back(v, mesh.point(v));
    }
    simplify(mesh, {.target = ratio(0.1), .topology = {.boundary = Boundary::locked}});
    for (const auto& [v, p] : border) {
        REQUIRE_FALSE(mesh.status(v).deleted());
        CHECK(mesh.point(v) == p);
    }
}

TEST_CASE("cancelling leaves the mesh unchanged") {
    Mesh mesh = build(torus(60));
    const auto before = face_set(mesh);
    const Report report =
        simplify(mesh, {.target = faces(4), .progress = [](Phase, double) { return Continue::cancel; }});
    CHECK(report.stop == StopReason::cancelled);
    CHECK(face_set(mesh) == before);
}

TEST_CASE("deleting whole components keeps the half-edge mesh consistent") {
    TriangleMesh soup;
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        const double x = double(random() % 1000), y = double(random() % 1000);
        const TriangleMesh one = test::scaled(test::tetrahedron(), 0.1 + (random() % 100) / 10.0);
        soup = test::both(std::move(soup), test::moved(one, {x, y, 0}));
    }
    Mesh mesh = build(soup);
    const Report report = simplify(mesh, {.target = faces(100), .preset = Preset::qem});
    CHECK(report.faces_out <= 100);
    CHECK(report.components_deleted == 175);
    CHECK(is_consistent(mesh));
}

TEST_CASE("virtual edges are refused because a half-edge mesh cannot represent their results") {
    Mesh mesh = build(torus(10));
    CHECK_THROWS_AS(simplify(mesh, {.topology = {.virtual_edges = VirtualEdges::on}}), OptionError);
}
