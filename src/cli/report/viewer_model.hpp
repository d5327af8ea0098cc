#pragma once
/// \file
/// What the page's 3D view shows of a model.

#include <cstdint>
#include <vector>

#include "cli/report/error_surface.hpp"
#include "cli/report/model_comparison.hpp"

namespace faqem::cli {

/// Where the view has its origin and how long its unit is: numbers near 1 for a graphics card, wherever and
/// however large the models are.
struct ViewerFrame {
    Vec3 centre = {};  ///< world space
    double unit = 1;   ///< model units, > 0
};

/// A GLB with two meshes in the frame: `look`, all instances of the model, and `error`, whose texture
/// coordinate u is the distance, in units of the frame. Skins and morph targets are in rest pose.
std::vector<std::uint8_t> viewer_glb(const FlattenedModel& model, const ErrorSurface& error,
                                     const ViewerFrame& frame);

/// The model's error surface coloured by distance, as a scene for the rasteriser. \param limit  full colour
Asset color_by_distance(const ErrorSurface& error, double limit);

}  // namespace faqem::cli
