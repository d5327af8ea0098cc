#pragma once
/// \file
/// The order in which the engine sees a mesh: what lies together in space lies together in memory.

#include <span>
#include <vector>

#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The used vertices and living faces of a prepared mesh along a space-filling curve, in engine units. The
/// engine waits for memory more than for anything else: on shuffled input this makes it three times as fast.
struct ReorderedMesh {
    std::vector<Index> vertex;  ///< slot -> vertex of the prepared mesh
    std::vector<Index> face;    ///< slot -> input face
    std::vector<engine::Vector3> positions;
    std::vector<Triangle> triangles;  ///< of slots

    /// Entries of per-face values in the order of the slots.
    /// \param values  one group of `width` for each input face, or empty
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

/// Vertices in Morton order of their places (ties by index), faces by their first vertex in it. O(n log n)
/// \throws what the poll throws
ReorderedMesh reorder(const PreprocessedMesh& prepared, engine::CancellationCheck check_cancelled = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/spatial_order-inl.hpp"
#endif
