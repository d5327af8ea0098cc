#pragma once
/// \file
/// Screen-space ambient occlusion.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace faqem::render {

struct Camera;

/// The visible surface at a pixel; inverse_depth is 0 if there is none.
struct Surfel {
    float inverse_depth = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// A square image of surfels.
struct SurfelImage {
    std::uint32_t size = 0;   ///< width and height in pixels
    double tan_half_fov = 0;  ///< tangent of half the field of view
    std::vector<Surfel> pixels;
};

/// Computes the fraction of ambient light that reaches each pixel, in (0, 1], from the height of neighbouring
/// pixels above its tangent plane (screen-space ambient occlusion of Crytek, Mittring 2007). Pixels without a
/// surface get 1.
std::vector<float> ambient_accessibility(const SurfelImage& surfels, const Camera& camera);

}  // namespace faqem::render
