#pragma once
/// \file
/// Finds the connected components that a simplification has removed although they were visible.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"
#include "faqem/report.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

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

/// A component that was removed.
struct FoundComponent {
    Index component = no_index;
    RemovedComponent removed;  ///< without the name of the part
};

/// Components without a face in the result.
struct FoundComponents {
    std::vector<FoundComponent>
        visible;              ///< of more than RemovedComponent::min_share, in descending order of it
    std::uint64_t small = 0;  ///< number of the others
    double small_share = 0;   ///< of the area, the sum over these
};

/// Finds the components of a mesh.
/// \param positions  one per vertex; read where faces refer to them
/// \param triangles  indices into `positions`
/// \return components in the order of their first face
/// Complexity: O(vertices log vertices + faces)
FAQEM_EXPORT FaceComponents face_components(const PositionView& positions, TriangleView triangles);

/// Finds the components without a face in the result.
/// \param faces    of the source, over all instances
/// \param is_left  one per component: nonzero if the result has a face of it
/// Complexity: O(faces)
FAQEM_EXPORT FoundComponents removed_components(std::span<const PlacedFace> faces,
                                                std::span<const std::uint8_t> is_left);

/// Adds the components without a face in the result to its report, with a warning. Does nothing unless the report
/// counts components that were collapsed, deleted or pruned.
/// \param mesh    the input of the simplification
/// \param result  of the simplification
/// Complexity: O(1), or O(vertices log vertices + faces) if there are such components
FAQEM_EXPORT void report_removed_components(const MeshView& mesh, SimplifyResult& result);

/// Adds a warning that names the largest of Report::removed_components if there are any, and one of the small
/// components if these had more than 2% of the area together.
FAQEM_EXPORT void warn_of_removed_components(Report& report, const FoundComponents& found);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/measure/removed_components-inl.hpp"
#endif
