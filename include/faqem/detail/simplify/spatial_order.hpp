#pragma once
/// \file
/// Reorders a mesh along a space-filling curve, so that elements that are close in space are close in memory.

#include <span>
#include <vector>

#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// The referenced vertices and remaining faces of a preprocessed mesh along a space-filling curve, in engine
/// units. The engine is limited by memory latency: on input in random order, reordering makes it three times
/// as fast.
struct ReorderedMesh {
    std::vector<Index> vertex;        ///< vertex slot -> vertex of the preprocessed mesh
    std::vector<Index> face;          ///< face slot -> input face
    std::vector<Vector3> positions;   ///< one per vertex slot
    std::vector<Triangle> triangles;  ///< one per face slot, of vertex slots

    /// Reorders per-face values to the order of the face slots.
    /// \param values  `width` values per input face, or empty
    /// \param width   number of values per face, >= 1
    /// \return `width` values per face slot; empty if `values` is empty
    /// Complexity: O(width * faces)
    template <class T>
    std::vector<T> per_face(std::span<const T> values, std::size_t width = 1) const {
        std::vector<T> result;
        if (values.empty()) return result;
        result.reserve(width * face.size());
        for (const Index f : face) {
            const auto group = values.subspan(width * f, width);
            result.insert(result.end(), group.begin(), group.end());
        }
        return result;
    }
};

/// Sorts vertices by the Morton code of their position (ties by index), and faces by their first vertex in
/// this order.
/// \param prepared  read only during the call
/// \param context   its threads are used; the result does not depend on their number
/// Complexity: O(n log n)
ReorderedMesh reorder(const PreprocessedMesh& prepared, const engine::RunContext& context = {});

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/spatial_order-inl.hpp"
#endif
