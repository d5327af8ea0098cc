#pragma once
/// \file
/// How far pictures of a result differ from those of its source.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "render/rasterizer.hpp"

namespace faqem::cli {

/// Mean squared differences of sRGB values in [0, 1], over the pixels that show one of the two models.
struct PictureError {
    double unlit = 0;
    double lit = 0;  ///< equal to `unlit` where lit pictures are not compared
};

/// PSNR in dB, the mean of unlit and lit pictures; 90 if nothing differs.
double picture_psnr(const PictureError& error);

/// Renders models from the same cameras as their source.
class PictureMeter {
public:
    /// Renders the source: six views around it of 320 x 320 pixels, unlit and, if a material has a normal map, lit.
    /// \param source   at least one face; its images are decoded and kept
    /// \param workers  threads; the cancellation check is not used
    /// Complexity: O(faces + texels of the source).
    PictureMeter(Asset source, const detail::Workers& workers);

    /// Compares a model with the source. An image that cannot be decoded is drawn white in both.
    PictureError operator()(Asset model) const;

    /// Compares a model that has the images of the source, with the same indices. Does not decode them again; those
    /// that the model holds are ignored.
    PictureError with_source_images(Asset model);

private:
    PictureError compare(const render::Scene& scene) const;

    // Calls use(index, frame) for each picture, on several threads.
    template <class Use>
    void for_each_frame(const render::Scene& scene, const Use& use) const;

    std::uint32_t threads_;
    render::Scene source_;
    std::vector<render::Camera> cameras_;
    std::vector<render::Shading> shadings_;
    std::vector<render::Frame> frames_;  // of the source, in sRGB before grey; by shading and camera
};

}  // namespace faqem::cli
