#pragma once
/// \file
/// Finds the connected components that a simplification has removed or shrunk although they were visible.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"
#include "faqem/report.hpp"
#include "faqem/simplify.hpp"

FAQEM_DETAIL_BEGIN

/// A face of a model, where an instance of its part is placed.
struct PlacedFace {
    Index component;              ///< number of its component; instances may have faces of the same one
    std::array<Vec3, 3> corners;  ///< finite
};

/// Connected components, with vertices at equal positions joined.
struct FaceComponents {
    std::vector<Index> component;  ///< one per face
    Index count = 0;
};

/// A component that was removed, or has shrunk.
struct FoundComponent {
    Index component = no_index;
    RemovedComponent removed;  ///< without the name of the part
};

/// Components without a face in the result, and others that have shrunk. The lists have those of more than
/// RemovedComponent::min_share, in descending order of it.
struct FoundComponents {
    std::vector<FoundComponent> removed, shrunk;
    std::uint64_t small = 0;  ///< number of the other removed ones
    double small_share = 0;   ///< of the area, the sum over these
};

/// Finds the components of a mesh.
/// \param positions  one per vertex; read where faces refer to them
/// \param triangles  indices into `positions`
/// \return components in the order of their first face
/// Complexity: O(vertices log vertices + faces)
FAQEM_EXPORT FaceComponents face_components(const PositionView& positions, TriangleView triangles);

/// The faces of one instance.
/// \param component  one per face
/// \param place      place(v): the position of a vertex in the scene
template <class Triangles, class Place>
void append_placed_faces(std::vector<PlacedFace>& faces, const Triangles& triangles,
                         std::span<const Index> component, const Place& place) {
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        const Triangle t = triangles[f];
        faces.push_back({component[f], {place(t[0]), place(t[1]), place(t[2])}});
    }
}

/// Finds the components without a face in the result, and those whose bounding box has become shorter along an axis, by
/// more than a fifth of its longest side.
/// \param source  faces of the source, over all instances
/// \param result  faces of the result, over all instances
/// \param count   number of components
/// Complexity: O(faces)
FAQEM_EXPORT FoundComponents removed_components(std::span<const PlacedFace> source,
                                                std::span<const PlacedFace> result, std::size_t count);

/// Whether components may be removed, or shrunk: some were, or a component of the result has fewer than 32 faces.
/// \param report  its counts
/// \param mesh    the result
/// Complexity: O(vertices log vertices + faces)
FAQEM_EXPORT bool may_lack_components(const Report& report, const TriangleMesh& mesh);

/// Adds the visible components that were removed or have shrunk to the report of the result, with warnings.
/// \param mesh    the input of the simplification
/// \param result  of the simplification
/// Complexity: may_lack_components(); if so, O(vertices log vertices + faces) of `mesh`
FAQEM_EXPORT void report_removed_components(const MeshView& mesh, SimplifyResult& result);

/// Adds warnings that name the largest of Report::removed_components and `shrunk_components` if there are any, and one of
/// the small components if these had more than 2% of the area together.
FAQEM_EXPORT void warn_of_removed_components(Report& report, const FoundComponents& found);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/measure/removed_components-inl.hpp"
#endif
