#pragma once
/// \file
/// Vertices at one position that a skin or a morph target moves apart.

#include <vector>

#include "faqem/asset.hpp"

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

}  // namespace faqem::detail
