#pragma once
/// \file
/// Shadow in the corners, from the depth buffer alone.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace faqem::render {

struct Camera;

/// What is seen at a pixel; inverse_depth is 0 where that is nothing.
struct Surfel {
    float inverse_depth = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// A square picture of surfels.
struct SurfelImage {
    std::uint32_t size = 0;
    double tan_half_fov = 0;  ///< of half the field of view
    std::vector<Surfel> pixels;
};

/// Share of the light from all around that reaches each pixel, in (0, 1]: how far neighbours on the screen
/// rise above its tangent plane (after Crytek's screen-space ambient occlusion, Mittring 2007).
std::vector<float> ambient_accessibility(const SurfelImage& surfels, const Camera& camera);

}  // namespace faqem::render
