#pragma once
/// \file
/// Entry point for OpenMesh triangle meshes, which are simplified in place. Needs OpenMesh.
///
/// The mesh is converted to arrays (connectivity, and locks from its status bits) and simplified. The
/// collapses are then repeated with OpenMesh's collapse(), so that handles and custom properties of the
/// remaining elements stay valid. The collapse loop does not use OpenMesh's data structure, which cannot
/// represent edges with three faces and is much slower.

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cassert>
#include <utility>
#include <vector>

#include "faqem/error.hpp"
#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN

/// The part of an OpenMesh mesh that may change.
enum class Region {
    all,
    selected_faces,  ///< only vertices whose faces are all selected may move or be removed
};

/// Properties of the mesh with additional input. An invalid handle means that there is no such property.
struct Properties {
    OpenMesh::VPropHandleT<float> weight = OpenMesh::VPropHandleT<float>();  ///< as MeshView::vertex_weights
    OpenMesh::FPropHandleT<Index> group = OpenMesh::FPropHandleT<Index>();   ///< as MeshView::face_groups
};

namespace openmesh_detail {

/// The mesh as arrays. Array index and handle of a vertex are equal; deleted faces are left out.
template <class Mesh>
struct Arrays {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<std::uint8_t> locked;              ///< one per vertex
    std::vector<float> weights;                    ///< empty, or one per vertex
    std::vector<Index> groups;                     ///< empty, or one per face
    std::vector<typename Mesh::FaceHandle> faces;  ///< handle of each face
};

template <class Mesh>
bool is_deleted(const Mesh& mesh, typename Mesh::VertexHandle v) {
    return mesh.has_vertex_status() && mesh.status(v).deleted();
}

template <class Mesh>
void lock_by_status(const Mesh& mesh, Region region, std::vector<std::uint8_t>& locked) {
    const auto lock = [&](typename Mesh::VertexHandle v) { locked[static_cast<std::size_t>(v.idx())] = 1; };
    if (mesh.has_vertex_status()) {
        for (const auto v : mesh.vertices())
            if (mesh.status(v).locked() || mesh.status(v).feature()) lock(v);
    }
    if (mesh.has_edge_status()) {
        for (const auto e : mesh.edges()) {
            if (!mesh.status(e).feature() && !mesh.status(e).locked()) continue;
            lock(mesh.to_vertex_handle(mesh.halfedge_handle(e, 0)));
            lock(mesh.to_vertex_handle(mesh.halfedge_handle(e, 1)));
        }
    }
    const bool has_faces = mesh.has_face_status();
    for (const auto f : mesh.faces()) {
        const bool outside = region == Region::selected_faces && !(has_faces && mesh.status(f).selected());
        if (!outside && !(has_faces && (mesh.status(f).locked() || mesh.status(f).feature()))) continue;
        for (const auto v : mesh.fv_range(f)) lock(v);
    }
}

// Deleted vertices keep the default weight.
template <class Mesh>
void read_properties(const Mesh& mesh, const Properties& properties, Arrays<Mesh>& arrays) {
    if (properties.weight.is_valid()) {
        arrays.weights.assign(mesh.n_vertices(), 1);
        for (const auto v : mesh.vertices())
            arrays.weights[static_cast<std::size_t>(v.idx())] = mesh.property(properties.weight, v);
    }
    if (properties.group.is_valid())
        for (const auto f : arrays.faces) arrays.groups.push_back(mesh.property(properties.group, f));
}

template <class Mesh>
Arrays<Mesh> read(const Mesh& mesh, Region region, const Properties& properties) {
    Arrays<Mesh> arrays;
    arrays.positions.resize(mesh.n_vertices());
    for (const auto v : mesh.vertices()) {
        const auto p = mesh.point(v);
        for (unsigned i = 0; i < 3; ++i) arrays.positions[static_cast<std::size_t>(v.idx())][i] = p[i];
    }
    for (const auto f : mesh.faces()) {
        Triangle triangle;
        std::size_t corner = 0;
        for (const auto v : mesh.fv_range(f)) triangle[corner++] = static_cast<Index>(v.idx());
        arrays.triangles.push_back(triangle);
        arrays.faces.push_back(f);
    }
    arrays.locked.assign(mesh.n_vertices(), 0);
    lock_by_status(mesh, region, arrays.locked);
    read_properties(mesh, properties, arrays);
    return arrays;
}

template <class Mesh>
void request_status(Mesh& mesh) {
    if (!mesh.has_vertex_status()) mesh.request_vertex_status();
    if (!mesh.has_edge_status()) mesh.request_edge_status();
    if (!mesh.has_halfedge_status()) mesh.request_halfedge_status();
    if (!mesh.has_face_status()) mesh.request_face_status();
}

template <class Mesh>
void move(Mesh& mesh, typename Mesh::VertexHandle v, const Vec3& p) {
    using Scalar = typename Mesh::Scalar;
    mesh.set_point(v, typename Mesh::Point(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]),
                                           static_cast<Scalar>(p[2])));
}

/// Flips the edge between faces f and g as in the history: f keeps the vertex at which its half-edge on that
/// edge begins. OpenMesh may assign the handles of the two new faces the other way round; they are then
/// exchanged.
template <class Mesh>
void flip_edge(Mesh& mesh, typename Mesh::FaceHandle& f, typename Mesh::FaceHandle& g) {
    for (const auto h : mesh.fh_range(f)) {
        if (mesh.opposite_face_handle(h) != g) continue;
        const auto from = mesh.from_vertex_handle(h);
        assert(mesh.is_flip_ok(mesh.edge_handle(h)));
        mesh.flip(mesh.edge_handle(h));
        bool stays = false;
        for (const auto v : mesh.fv_range(f)) stays |= v == from;
        if (!stays) std::swap(f, g);
        return;
    }
    assert(!"the faces of a flip share an edge");
}

/// Repeats the collapses, deletions and flips of `history` on the mesh that it was recorded for.
template <class Mesh>
void replay(Mesh& mesh, const Arrays<Mesh>& arrays, const CollapseHistory& history) {
    std::vector<typename Mesh::VertexHandle> handle(history.positions.size() + history.collapses.size());
    for (std::size_t v = 0; v < history.positions.size(); ++v)
        handle[v] = typename Mesh::VertexHandle(static_cast<int>(v));
    std::size_t deleted = 0;
    const auto delete_faces_until = [&](std::size_t time) {
        for (; deleted < history.deleted_faces.size() && history.deleted_faces[deleted].time <= time;
             ++deleted)
            mesh.delete_face(arrays.faces[history.deleted_faces[deleted].face], true);
    };
    for (std::size_t k = 0; k < history.collapses.size(); ++k) {
        delete_faces_until(k);
        const Collapse& collapse = history.collapses[k];
        const auto survivor = handle[collapse.first];
        const auto halfedge = mesh.find_halfedge(handle[collapse.second], survivor);
        assert(halfedge.is_valid() && mesh.is_collapse_ok(halfedge));
        mesh.collapse(halfedge);
        handle[history.positions.size() + k] = survivor;
    }
    delete_faces_until(history.collapses.size());
    // Faces of zero area that remain are not part of the result.
    std::vector<std::uint8_t> remains(arrays.faces.size(), 0);
    for (const Index f : history.remaining_faces) remains[f] = 1;
    for (std::size_t f = 0; f < remains.size(); ++f)
        if (!remains[f] && !mesh.status(arrays.faces[f]).deleted()) mesh.delete_face(arrays.faces[f], true);
    std::vector<typename Mesh::FaceHandle> faces = arrays.faces;
    for (std::size_t k = history.collapses.size(); k < history.patch_count(); ++k)
        flip_edge(mesh, faces[history.patch(k)[0]], faces[history.patch(k)[1]]);
    for (std::size_t i = 0; i < history.remaining_versions.size(); ++i) {
        const Index version = history.remaining_versions[i];
        const bool original = version < history.positions.size();
        const Vec3& final_position = history.final_position(i);
        if (!original || final_position != history.position(version))
            move(mesh, handle[version], final_position);
    }
}

}  // namespace openmesh_detail

/// Simplifies an OpenMesh mesh in place. The link condition is always enforced, so that the result is a valid
/// half-edge mesh.
/// \param mesh        any TriMesh_ArrayKernelT. Locked and feature vertices do not move, nor do the vertices
///                    of locked or feature edges and faces. Deleted elements are ignored. Missing status
///                    properties are requested. Removed elements are marked as deleted; call
///                    mesh.garbage_collection() to remove them. Normals are not updated
/// \param options     see Options; topology.link, topology.weld and history are overridden; budget,
///                    visibility and bake have no effect
/// \param region      the part of the mesh that may change
/// \param properties  optional weights and groups
/// \return the report. If the progress callback cancels, report.stop is StopReason::cancelled and the mesh is
///         unchanged. Report::max_error is measured in double precision, before positions are rounded to the
///         scalar of the mesh
/// \throws OptionError  an option is out of range, or virtual edges are on, which a half-edge mesh cannot
///                      have
/// \throws InputError   a position is not finite, or a weight is out of range
/// \throws whatever the progress callback throws
/// Complexity: O(n log n) in the number of faces for bounded valence.
template <class Traits>
Report simplify(OpenMesh::TriMesh_ArrayKernelT<Traits>& mesh, Options options = {},
                Region region = Region::all, const Properties& properties = {}) {
    using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
    if (options.topology.virtual_edges == VirtualEdges::on)
        throw OptionError("virtual edges must be off: a half-edge mesh cannot represent the result");
    options.topology.link = LinkCondition::strict;
    options.topology.weld = Weld::none;
    options.history = Recording::on;
    const openmesh_detail::Arrays<Mesh> arrays = openmesh_detail::read<Mesh>(mesh, region, properties);
    const MeshView view{arrays.positions, arrays.triangles, arrays.groups,
                        nullptr,          arrays.locked,    arrays.weights};
    const SimplifyResult result = simplify(view, options);
    if (result.report.stop == StopReason::cancelled) return result.report;
    openmesh_detail::request_status<Mesh>(mesh);
    openmesh_detail::replay<Mesh>(mesh, arrays, result.history);
    return result.report;
}

FAQEM_NAMESPACE_END
