#pragma once
/// \file
/// Door (a): flat arrays in, flat arrays out. Needs the standard library only.

#include <vector>

#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/mesh.hpp"
#include "faqem/options.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN

/// What simplify() gives back. Owns everything.
struct SimplifyResult {
    TriangleMesh mesh;                 ///< groups and attributes are there if the input had them
    std::vector<Index> vertex_origin;  ///< per vertex of `mesh`: an input vertex it grew from
    std::vector<Index> face_origin;    ///< per face of `mesh`: the input face it was
    Report report;
    CollapseHistory history;  ///< empty unless options.history is on
};

/// Collapses vertex pairs, cheapest first, until the target is reached (paper, Algorithm 1).
/// \param mesh     any triangle soup; read only during the call
/// \param options  see Options; `bake` is ignored here
/// \return the small mesh, the report, and the history if asked for. An empty mesh gives an empty result.
///         A vertex that was not moved keeps its position to the last bit. Where the progress callback
///         cancels, report.stop says so, and the mesh is as far as it was if collapses were under way, or
///         else empty.
/// \throws OptionError  an option is out of range
/// \throws InputError   an index is out of range, a position is not finite, an array has the wrong length,
///                      or there are more than 2^32 - 2 vertices or faces, or 2^32 - 2 corners / 3
/// Complexity: O(n log n) time in the number of faces for bounded valence, O(n) memory. With max_error and no
/// target up to 12 such runs, each from the original and measured; `progress` goes over all of them.
FAQEM_EXPORT SimplifyResult simplify(const MeshView& mesh, const Options& options = {});

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/simplify-inl.hpp"
#endif
