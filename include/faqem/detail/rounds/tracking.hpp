#pragma once
/// \file
/// The bindings of original vertices to faces, whose distances rounds track.

#include <cstddef>
#include <utility>
#include <vector>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/detail/rounds/round_mesh.hpp"
#include "faqem/engine/tracking/vertex_bindings.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN
namespace rounds {

/// A compact mesh, as NearFaceSearch needs it. References the mesh. O(faces) to construct
class SearchedMesh {
public:
    explicit SearchedMesh(const Mesh& mesh)
        : mesh_(mesh), corners_(mesh.vertices.size(), [&](auto&& put) {
              for (Index f = 0; f < mesh.faces.size(); ++f)
                  for (unsigned k = 0; k < 3; ++k) put(mesh.faces[f].v[k], 4 * f + k);
          }) {}

    engine::Vector3 position(Index v) const { return engine::to_eigen(mesh_.vertices[v].p); }
    const Triangle& triangle(Index f) const { return mesh_.faces[f].v; }
    std::size_t degree(Index v) const { return corners_[v].size(); }
    bool is_high_valence(Index v) const { return degree(v) > 256; }
    template <class Visit>
    void for_each_face(Index v, Visit&& visit) const {
        for (const Corner c : corners_[v]) visit(c >> 2, c & 3);
    }

private:
    const Mesh& mesh_;
    Buckets<Corner> corners_;
};

/// Binds the original vertices to faces of a compact mesh. Typically O(faces + original vertices)
/// \param slots  number of vertex slots of the input
inline void bind_all(Mesh& mesh, const RoundTracking& tracking, std::size_t slots,
                     const RunContext& context) {
    const std::vector<Index> now = merged_vertices(mesh, slots);
    const std::size_t originals = tracking.vertex_map.size();
    const Buckets<Index> merged(mesh.vertices.size(), [&](auto&& put) {
        for (Index i = 0; i < originals; ++i) {
            const Index slot = tracking.vertex_map[i];
            if (slot != no_index && now[slot] != no_index) put(now[slot], i);
        }
    });
    mesh.original = tracking.original;
    mesh.distance_weight = static_cast<float>(tracking.weight * mesh.scale * mesh.scale);
    mesh.first_bound.assign(mesh.faces.size(), no_index);
    mesh.next_bound.assign(originals, no_index);
    const SearchedMesh searched(mesh);
    parallel_blocks(mesh.vertices.size(), elements_per_block, context,
                    [&](std::size_t first, std::size_t end) {
                        engine::NearFaceSearch search(searched);
                        for (Index v = static_cast<Index>(first); v < end; ++v) {
                            if (merged[v].empty() || searched.degree(v) == 0) continue;
                            search.find(
                                v, merged[v], [&](Index i) { return tracking.original->position(i); },
                                [&](Index i, Index f) { mesh.next_bound[i] = f; });
                        }
                    });
    for (Index i = 0; i < originals; ++i) {
        Index& next = mesh.next_bound[i];
        if (next != no_index) next = std::exchange(mesh.first_bound[next], i);
    }
}

/// The face of each original vertex, or no_index.
inline std::vector<Index> bound_faces(const Mesh& mesh) {
    std::vector<Index> faces(mesh.next_bound.size(), no_index);
    for (Index f = 0; f < mesh.first_bound.size(); ++f)
        for (Index i = mesh.first_bound[f]; i != no_index; i = mesh.next_bound[i]) faces[i] = f;
    return faces;
}

}  // namespace rounds
FAQEM_DETAIL_END
