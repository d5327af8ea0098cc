#pragma once
/// \file
/// Entry point for flat arrays. Needs only the standard library, and Eigen in header-only mode.

#include <vector>

#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/mesh.hpp"
#include "faqem/options.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN

/// Result of simplify(). Owns its arrays.
struct SimplifyResult {
    TriangleMesh mesh;                 ///< with groups and attributes if the input has them
    std::vector<Index> vertex_origin;  ///< source vertex: an input vertex that was collapsed into each vertex
    std::vector<Index> face_origin;    ///< the input face of each face
    Report report;
    CollapseHistory history;  ///< empty unless Options::history is on
};

/// Simplifies a mesh by collapsing vertex pairs in the order of their cost until the target is reached
/// (FA-QEM, arXiv 2605.14029, Algorithm 1).
/// \param mesh     any triangle soup; read only during the call
/// \param options  see Options; what concerns scenes and files has no effect: budget, visibility, bake, format, larger,
///                 max_bytes, compress and quantize
/// \return the simplified mesh, the report, and the history if requested. An empty mesh gives an empty
///         result. A vertex that was not moved has its input position, bit by bit. If the progress callback
///         cancels, report.stop is StopReason::cancelled, and the mesh is an intermediate one or empty
/// \throws OptionError  an option is out of range
/// \throws InputError   an index is out of range, a position or attribute is not finite, a weight is out of
///                      range, an array has the wrong length, or there are more than 2^32 - 2 vertices or
///                      715,827,880 faces
/// \throws whatever the progress callback throws
/// Thread-safe: several threads may simplify at once, also the same mesh.
/// Complexity: O(n log n) time and O(n) memory in the number n of faces, for bounded valence. With max_error and no
/// target, up to 13 runs from the original, each with a measurement; `progress` covers all of them.
FAQEM_EXPORT SimplifyResult simplify(const MeshView& mesh, const Options& options = {});

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/simplify-inl.hpp"
#endif
