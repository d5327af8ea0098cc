#pragma once
/// \file
/// Parts that move: vertices at one position that a skin or a morph target moves apart, and parts that are flat at rest and
/// have a shape in a morph target.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Differences between vertices that come from the rounding of the numbers in the file.
struct MotionRounding {
    double weight = 1e-6;       ///< of the weight of a joint
    std::vector<double> shift;  ///< by morph target: of a component of a displacement, model units
};

/// The rounding of the joint weights and the displacements of a part: that of the integers in its file (motion_steps()),
/// or of floats. Complexity: O(vertices)
MotionRounding motion_rounding(const Asset& asset, const Part& part);

/// Welds the vertices of a part by position and motion.
/// \param distance  largest distance between welded positions, model units, as Topology::weld_distance
/// \return the triangles with each vertex replaced by the first one near its position with the same weights of joints and
///         the same displacements, except for rounding; empty if no vertices near one position differ, so that a weld by
///         position has the same result
/// Complexity: O(vertices + faces), if few vertices at one position differ from each other
std::vector<Triangle> welded_by_motion(const Part& part, const MotionRounding& rounding, double distance);

/// Whether a part has morph targets with displacements that are not all zero. O(vertices)
bool has_displacements(const Part& part);

/// The curve for the face budget of a part with displacements: that of the part at rest unless it is flat down to
/// `faces` faces; then, that of the first morph target, at weight 1, in which it is not.
/// \param rest     of cost_curve() for `mesh`
/// \param part     has_displacements()
/// \param mesh     the part as the input of the engine
/// \param options  of the run
/// \param context  progress is not reported
/// \throws as cost_curve()
/// Complexity: O(n log n) for each target, if the part is flat at rest
CostCurve curve_in_motion(CostCurve rest, const Part& part, const MeshView& mesh, const Options& options,
                          const engine::RunContext& context, std::uint64_t faces);

/// Bends a part that is flat at rest a little into the shape that it has in morph targets. All collapses of a flat mesh
/// cost nothing; this decides about their order, and leaves more faces where the displacements are curved.
/// \return the positions moved by at most `bend` times the bounding-box diagonal; empty if the part is not flat at rest
///         down to `faces` faces, or is flat in all targets
/// Parameters, exceptions and complexity as curve_in_motion().
std::vector<Vec3> bent_positions(const Part& part, const MeshView& mesh, const Options& options,
                                 const engine::RunContext& context, std::uint64_t faces);

/// Largest displacement of bent_positions(), as a share of the diagonal: about the rounding of floats. In the engine,
/// which computes with doubles relative to the vertices of a pair, costs that are its fourth power are exact.
inline constexpr double bend = 2e-7;

}  // namespace faqem::detail
