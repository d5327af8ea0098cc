// simplify() for OpenMesh meshes.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <random>

#include "faqem/openmesh.hpp"
#include "support/catch.hpp"

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;

struct Soup {
    std::vector<faqem::Vec3> positions;
    std::vector<faqem::Triangle> triangles;
};

// A bumpy n x n torus: closed, genus 1.
Soup torus(unsigned n) {
    Soup soup;
    for (unsigned i = 0; i < n; ++i) {
        for (unsigned j = 0; j < n; ++j) {
            const double a = 2 * M_PI * i / n, b = 2 * M_PI * j / n;
            const double r = 1 + 0.05 * std::sin(5 * a + 3 * b);
            soup.positions.push_back(
                {(3 + r * std::cos(b)) * std::cos(a), (3 + r * std::cos(b)) * std::sin(a), r * std::sin(b)});
            const faqem::Index p = i * n + j, q = (i + 1) % n * n + j, s = i * n + (j + 1) % n,
                               t = (i + 1) % n * n + (j + 1) % n;
            soup.triangles.push_back({p, q, t});
            soup.triangles.push_back({p, t, s});
        }
    }
    return soup;
}

// A height field of n x n squares with an open boundary and a hole.
Soup height_field_with_hole(unsigned n) {
    Soup soup;
    for (unsigned i = 0; i <= n; ++i) {
        for (unsigned j = 0; j <= n; ++j) {
            const double x = double(i) / n, y = double(j) / n;
            soup.positions.push_back({x, y, 0.1 * std::sin(7 * x) * std::cos(5 * y)});
        }
    }
    for (unsigned i = 0; i < n; ++i) {
        for (unsigned j = 0; j < n; ++j) {
            if (i > n / 3 && i < n / 2 && j > n / 3 && j < n / 2) continue;
            const faqem::Index p = i * (n + 1) + j, q = p + n + 1;
            soup.triangles.push_back({p, q, q + 1});
            soup.triangles.push_back({p, q + 1, p + 1});
        }
    }
    return soup;
}

template <class M = Mesh>
M build(const Soup& soup) {
    M mesh;
    std::vector<typename M::VertexHandle> handles;
    for (const faqem::Vec3& p : soup.positions) {
        using S = typename M::Scalar;
        handles.push_back(mesh.add_vertex(typename M::Point(S(p[0]), S(p[1]), S(p[2]))));
    }
    for (const faqem::Triangle& t : soup.triangles)
        mesh.add_face(handles[t[0]], handles[t[1]], handles[t[2]]);
    return mesh;
}

// Corner positions of every face that is not deleted, rotated so that the smallest comes first; sorted.
template <class M>
std::vector<std::array<faqem::Vec3, 3>> face_set(const M& mesh) {
    std::vector<std::array<faqem::Vec3, 3>> faces;
    for (const auto f : mesh.faces()) {
        std::array<faqem::Vec3, 3> corners;
        std::size_t i = 0;
        for (const auto v : mesh.fv_range(f)) {
            const auto p = mesh.point(v);
            corners[i++] = {p[0], p[1], p[2]};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        faces.push_back(corners);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

std::vector<std::array<faqem::Vec3, 3>> face_set(const faqem::TriangleMesh& mesh) {
    std::vector<std::array<faqem::Vec3, 3>> faces;
    for (const faqem::Triangle& t : mesh.triangles) {
        std::array<faqem::Vec3, 3> corners = {mesh.positions[t[0]], mesh.positions[t[1]],
                                              mesh.positions[t[2]]};
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        faces.push_back(corners);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
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

}  // namespace

TEST_CASE("simplifying a manifold OpenMesh mesh gives the same faces as simplifying its arrays") {
    const Soup soup = GENERATE(torus(40), height_field_with_hole(40));
    const auto preset = GENERATE(faqem::Preset::qem, faqem::Preset::paper, faqem::Preset::stmw,
                                 faqem::Preset::fast, faqem::Preset::balanced, faqem::Preset::best);
    const double share = GENERATE(0.5, 0.1, 0.01);
    faqem::Options options{.target = faqem::ratio(share), .preset = preset};
    Mesh mesh = build(soup);
    const faqem::Report report = faqem::simplify(mesh, options);

    options.topology.link = faqem::LinkCondition::strict;
    options.topology.weld = faqem::Weld::none;
    const faqem::SimplifyResult arrays = faqem::simplify({soup.positions, soup.triangles}, options);
    CHECK(face_set(mesh) == face_set(arrays.mesh));
    CHECK(report.faces_out == arrays.mesh.triangles.size());
    CHECK(report.faces_out < soup.triangles.size());
    CHECK(is_consistent(mesh));
}

TEST_CASE("preset best flips the same edges of an OpenMesh mesh as of its arrays") {
    Soup soup = torus(40);
    for (std::size_t v = 0; v < soup.positions.size(); ++v) {
        for (std::size_t k = 0; k < 3; ++k) soup.positions[v][k] += 0.02 * std::sin(double(v * (3 * k + 7)));
    }
    faqem::Options options{.target = faqem::ratio(0.1), .preset = faqem::Preset::best};
    Mesh mesh = build(soup);
    const faqem::Report report = faqem::simplify(mesh, options);
    CHECK(report.edges_flipped > 0);
    options.topology.link = faqem::LinkCondition::strict;
    options.topology.weld = faqem::Weld::none;
    CHECK(face_set(mesh) == face_set(faqem::simplify({soup.positions, soup.triangles}, options).mesh));
    CHECK(is_consistent(mesh));
}

TEST_CASE("max_error gives the same result for an OpenMesh mesh as for its arrays") {
    const Soup soup = torus(32);
    faqem::Options options{.max_error = faqem::of_diagonal(0.01)};
    Mesh mesh = build(soup);
    const faqem::Report report = faqem::simplify(mesh, options);
    REQUIRE(report.max_error);
    CHECK(report.max_error->within());
    CHECK(report.stop == faqem::StopReason::reached_max_error);
    CHECK(report.faces_out < soup.triangles.size() / 2);
    options.topology.link = faqem::LinkCondition::strict;
    options.topology.weld = faqem::Weld::none;
    CHECK(face_set(mesh) == face_set(faqem::simplify({soup.positions, soup.triangles}, options).mesh));
    CHECK(is_consistent(mesh));
}

TEST_CASE("a closed OpenMesh torus stays a closed torus") {
    Mesh mesh = build(torus(48));
    const faqem::Report report =
        faqem::simplify(mesh, {.target = faqem::ratio(0.02), .preset = faqem::Preset::qem});
    CHECK(report.stop == faqem::StopReason::reached_target);
    mesh.garbage_collection();
    CHECK(mesh.n_faces() == report.faces_out);
    CHECK(static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) +
              static_cast<int>(mesh.n_faces()) ==
          0);
    for (const auto e : mesh.edges()) REQUIRE_FALSE(mesh.is_boundary(e));
}

TEST_CASE("handles and custom properties of remaining elements stay valid") {
    const Soup soup = torus(30);
    Mesh mesh = build(soup);
    OpenMesh::VPropHandleT<int> vertex_number;
    OpenMesh::FPropHandleT<int> face_number;
    mesh.add_property(vertex_number);
    mesh.add_property(face_number);
    for (const auto v : mesh.vertices()) mesh.property(vertex_number, v) = v.idx() * 7;
    for (const auto f : mesh.faces()) mesh.property(face_number, f) = f.idx() * 3;
    faqem::simplify(mesh, {.target = faqem::ratio(0.2)});
    std::size_t living = 0;
    for (const auto v : mesh.vertices()) {
        REQUIRE(mesh.property(vertex_number, v) == v.idx() * 7);
        ++living;
    }
    for (const auto f : mesh.faces()) REQUIRE(mesh.property(face_number, f) == f.idx() * 3);
    CHECK(living < soup.positions.size() / 3);
}

TEST_CASE("locked and feature elements do not move") {
    const Soup soup = height_field_with_hole(24);
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
    faqem::simplify(mesh, {.target = faqem::ratio(0.1)});
    for (const auto& [v, p] : kept) {
        REQUIRE_FALSE(mesh.status(v).deleted());
        CHECK(mesh.point(v) == p);
    }
}

TEST_CASE("faces outside the selected region are not deleted") {
    const Soup soup = height_field_with_hole(24);
    Mesh mesh = build(soup);
    mesh.request_face_status();
    for (const auto f : mesh.faces()) mesh.status(f).set_selected(mesh.calc_face_centroid(f)[0] < 0.5);
    std::vector<Mesh::FaceHandle> outside;
    for (const auto f : mesh.faces()) {
        if (!mesh.status(f).selected()) outside.push_back(f);
    }
    faqem::simplify(mesh, {.target = faqem::faces(4)}, faqem::Region::selected_faces);
    std::size_t living = 0;
    for (const auto f : mesh.faces()) living += f.is_valid();
    for (const auto f : outside) REQUIRE_FALSE(mesh.status(f).deleted());
    CHECK(living < soup.triangles.size() * 6 / 10);
}

TEST_CASE("weights and groups from properties give the same result as weights and groups in arrays") {
    const Soup soup = torus(40);
    Mesh mesh = build(soup);
    faqem::Properties properties;
    mesh.add_property(properties.weight);
    mesh.add_property(properties.group);
    std::vector<float> weights;
    std::vector<faqem::Index> groups;
    for (const auto v : mesh.vertices()) {
        weights.push_back(mesh.point(v)[0] > 0 ? 10 : 1);
        mesh.property(properties.weight, v) = weights.back();
    }
    for (const auto f : mesh.faces()) {
        groups.push_back(mesh.calc_face_centroid(f)[1] > 0);
        mesh.property(properties.group, f) = groups.back();
    }
    faqem::Options options{.target = faqem::ratio(0.1)};
    options.topology.group_boundaries = faqem::GroupBoundaries::preserved;
    const faqem::Report report = faqem::simplify(mesh, options, faqem::Region::all, properties);
    CHECK(report.faces_out <= report.target_faces);
    options.topology.link = faqem::LinkCondition::strict;
    options.topology.weld = faqem::Weld::none;
    faqem::MeshView view{soup.positions, soup.triangles, groups};
    view.vertex_weights = weights;
    CHECK(face_set(mesh) == face_set(faqem::simplify(view, options).mesh));
    view.face_groups = {};
    CHECK(face_set(mesh) != face_set(faqem::simplify(view, options).mesh));
    CHECK(is_consistent(mesh));
    unsigned important = 0;
    for (const auto f : mesh.faces()) important += mesh.calc_face_centroid(f)[0] > 0;
    CHECK(important > 0.6 * double(mesh.n_faces() - (soup.triangles.size() - report.faces_out)));
}

TEST_CASE("small components of an OpenMesh mesh are pruned even at ratio 1") {
    Soup soup = torus(20);
    const auto first = static_cast<faqem::Index>(soup.positions.size());
    for (const faqem::Vec3& p : {faqem::Vec3{9, 0, 0}, {9.1, 0, 0}, {9, 0.1, 0}}) soup.positions.push_back(p);
    soup.triangles.push_back({first, first + 1, first + 2});
    const double share = GENERATE(1.0, 0.3);
    faqem::Options options{.target = faqem::ratio(share)};
    options.topology.prune = faqem::model_units(0.2);
    Mesh mesh = build(soup);
    const faqem::Report report = faqem::simplify(mesh, options);
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
    const faqem::Report first = faqem::simplify(mesh, {.target = faqem::ratio(0.5)});
    CHECK(first.faces_in == 2 * 30 * 30 - 1);
    const faqem::Report second = faqem::simplify(mesh, {.target = faqem::faces(100)});
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
    faqem::simplify(mesh, {.target = faqem::ratio(0.1), .topology = {.boundary = faqem::Boundary::locked}});
    for (const auto& [v, p] : border) {
        REQUIRE_FALSE(mesh.status(v).deleted());
        CHECK(mesh.point(v) == p);
    }
}

TEST_CASE("cancelling leaves the mesh unchanged") {
    Mesh mesh = build(torus(60));
    const auto before = face_set(mesh);
    const faqem::Report report =
        faqem::simplify(mesh, {.target = faqem::faces(4),
                               .progress = [](faqem::Phase, double) { return faqem::Continue::cancel; }});
    CHECK(report.stop == faqem::StopReason::cancelled);
    CHECK(face_set(mesh) == before);
}

TEST_CASE("deleting whole components keeps the half-edge mesh consistent") {
    Soup soup;
    std::mt19937 random(7);
    for (faqem::Index i = 0; i < 200; ++i) {
        const double x = double(random() % 1000), y = double(random() % 1000),
                     s = 0.1 + (random() % 100) / 10.0;
        const faqem::Index p = 4 * i;
        soup.positions.insert(soup.positions.end(), {{x, y, 0}, {x + s, y, 0}, {x, y + s, 0}, {x, y, s}});
        for (const faqem::Triangle& t : {faqem::Triangle{p, p + 2, p + 1},
                                         {p, p + 1, p + 3},
                                         {p + 1, p + 2, p + 3},
                                         {p, p + 3, p + 2}}) {
            soup.triangles.push_back(t);
        }
    }
    Mesh mesh = build(soup);
    const faqem::Report report =
        faqem::simplify(mesh, {.target = faqem::faces(100), .preset = faqem::Preset::qem});
    CHECK(report.faces_out <= 100);
    CHECK(report.components_deleted == 175);
    CHECK(is_consistent(mesh));
}

TEST_CASE("virtual edges are refused because a half-edge mesh cannot represent their results") {
    Mesh mesh = build(torus(10));
    CHECK_THROWS_AS(faqem::simplify(mesh, {.topology = {.virtual_edges = faqem::VirtualEdges::on}}),
                    faqem::OptionError);
}
