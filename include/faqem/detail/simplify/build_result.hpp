#pragma once
/// \file
/// Converts the final state of the engine to a SimplifyResult.

#include <span>
#include <vector>

#include "faqem/detail/fitting/edge_flip_search.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/constraints/wedges.hpp"
#include "faqem/engine/loop_options.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_DETAIL_BEGIN

/// Fills mesh, vertex_origin and face_origin of the result, with vertices and faces in input order. Faces of
/// zero area are left out and added to Report::faces_dropped.
/// \param mesh             input of simplify(): groups and the number of faces are read
/// \param prepared         `mesh` after preprocess()
/// \param reordered        maps the slots of `collapse_mesh` to vertices and faces of `prepared`
/// \param collapse_mesh    the simplified surface, in engine units
/// \param wedges           corner attributes of `collapse_mesh`, or empty
/// \param source_vertices  one per vertex slot: the vertex of `prepared` that has exactly the same position,
///                         or no_index
/// \param result           filled; its report is updated
/// \return for each vertex of the result its slot in `collapse_mesh`
/// Complexity: O(n)
std::vector<Index> build_result(const MeshView& mesh, const PreprocessedMesh& prepared,
                                const ReorderedMesh& reordered, const engine::CollapseMesh& collapse_mesh,
                                const engine::Wedges& wedges, std::span<const Index> source_vertices,
                                SimplifyResult& result);

/// Converts the positions of recorded collapses from engine units to model units.
/// \param prepared         defines the scale and the vertices that the collapses start from
/// \param collapses        all collapses of the run in order; changed in place
/// Complexity: O(n)
void to_model_units(const PreprocessedMesh& prepared, std::vector<Collapse>& collapses);

/// Completes the history of the result: original mesh, pruned faces, face groups and remaining faces.
/// \param mesh       input of simplify()
/// \param pruned     PreprocessedMesh::pruned; these faces become deleted faces with time 0
/// \param positions  PreprocessedMesh::positions; moved into the history
/// \param triangles  PreprocessedMesh::triangles; moved into the history
/// \param result     its mesh must not be fitted yet, and its history must hold the collapses, their patches,
///                   the deleted faces and the remaining versions
/// Complexity: O(n)
void finish_history(const MeshView& mesh, const PruneResult& pruned, std::vector<Vec3> positions,
                    std::vector<Triangle> triangles, SimplifyResult& result);

/// Reverts the vertices of faces that have zero area, until no such face is left. Vertex fitting and the
/// rounding of its positions must not create degenerate faces, since build_result() has removed them.
/// \param before     one position per vertex before fitting, model units
/// \param triangles  faces, after edge flips
/// \param now        one position per vertex after fitting; vertices of degenerate faces are set back to
///                   `before`
/// \return false if a face has zero area even with all its vertices reverted
/// Complexity: O(faces) per pass; each pass but the last reverts at least one vertex
FAQEM_EXPORT bool revert_degenerate_faces(std::span<const Vec3> before, std::span<const Triangle> triangles,
                                          std::vector<Vec3>& now);

/// Adds the fitted positions and the edge flips to the history of the result.
/// \param flips   pairs of face indices of the result, in the order in which the flips were made
/// \param result  its mesh and report.vertices_fitted must be final
void record_fitting(std::span<const EdgeFlip> flips, SimplifyResult& result);

/// Adds the counters of an engine run to those of the report.
void add_counts(const engine::LoopResult& loop_result, Report& report);

/// Sets the counts of the result and of preprocessing in the report, and adds warnings.
/// \param options   the options of the run
/// \param settings  the settings derived from them
/// \param prepared  the preprocessed input
/// \param result    its mesh must be final; its report is completed
void finish_report(const Options& options, const Settings& settings, const PreprocessedMesh& prepared,
                   SimplifyResult& result);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/build_result-inl.hpp"
#endif
