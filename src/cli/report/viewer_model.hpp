#pragma once
/// \file
/// The models that are embedded in the page for its 3D view and heat maps.

#include <cstdint>
#include <vector>

#include "cli/report/error_surface.hpp"
#include "cli/report/model_comparison.hpp"

namespace faqem::cli {

/// Coordinate frame of the 3D view. It normalizes positions to magnitudes near 1, because graphics hardware
/// computes in single precision.
struct ViewerFrame {
    Vec3 centre = {};         ///< origin of the frame, world space
    double unit = 1;          ///< length of its unit, model units, > 0
    double max_distance = 1;  ///< of both error surfaces, model units, > 0
};

/// Returns a GLB file with two meshes in the frame: `look` contains all instances of the model with its
/// materials, `error` the error surface with the root of the distance as a share of ViewerFrame::max_distance as
/// texture coordinate u. Positions are rounded to multiples of 2^-15, and geometry is compressed with meshoptimizer.
/// Skins and morph targets are in their pose at rest.
std::vector<std::uint8_t> viewer_glb(const FlattenedModel& model, const ErrorSurface& error,
                                     const ViewerFrame& frame);

/// Returns the error surface with vertex colours by distance, for the rasterizer.
/// \param limit  distance at the end of the colour scale, model units
Asset color_by_distance(const ErrorSurface& error, double limit);

}  // namespace faqem::cli
