#pragma once
/// \file
/// From what the engine leaves to what the caller gets.

#include <span>
#include <vector>

#include "faqem/detail/fitting/edge_flip_search.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/constraints/wedges.hpp"
#include "faqem/engine/loop.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Fills the mesh of the result, and whose its vertices and faces were: both in input order; what has no area
/// is left out and counted.
/// \param now     the slots of the complex
/// \param source_vertices  of each vertex slot: the vertex of the prepared mesh whose place it has, or no_index
/// \return the slot of each vertex of the result
/// \throws what the poll throws.
/// O(n)
std::vector<Index> build_result(const MeshView& mesh, const PreprocessedMesh& prepared,
                                const ReorderedMesh& reordered, const engine::CollapseMesh& collapse_mesh,
                                const engine::Wedges& wedges, std::span<const Index> source_vertices,
                                engine::CancellationCheck check_cancelled, SimplifyResult& result);

/// Brings what an engine recorded to model units.
/// \throws what the poll throws.
/// O(n)
void to_model_units(const PreprocessedMesh& prepared, engine::CancellationCheck check_cancelled,
                    std::vector<Collapse>& collapses);

/// Fills what the recorder left open in the history of the result.
/// \param pruned                those of the prepared mesh, as are the next two
/// \param positions, triangles  taken over
/// \param result                its mesh not fitted; of its history the collapses, their patches, the deleted
///                              faces and the kept versions
/// O(n)
void finish_history(const MeshView& mesh, const PruneResult& pruned, std::vector<Vec3> positions,
                    std::vector<Triangle> triangles, SimplifyResult& result);

/// Puts vertices of faces that have no area back to where they were, until all have one: moves and roundings
/// of the relaxation are not to make what build_result() has left out.
/// \return false: some have none with all their vertices back
bool revert_degenerate_faces(std::span<const Vec3> before, std::span<const Triangle> triangles,
                             std::vector<Vec3>& now);

/// Adds to the history of the result where its vertices went in the end, and which edges were flipped.
/// \param flips  of faces of the result
void record_fitting(std::span<const EdgeFlip> flips, SimplifyResult& result);

/// Adds what an engine counted.
void add_counts(const engine::LoopResult& loop_result, Report& report);

/// Counts the mesh of the result and what was prepared, and says in words what the user should know.
void finish_report(const Options& options, const Settings& settings, const PreprocessedMesh& prepared,
                   SimplifyResult& result);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/build_result-inl.hpp"
#endif
