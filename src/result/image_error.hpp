#pragma once
/// \file
/// What the error of each image adds to that of pictures.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/texture/pending_images.hpp"
#include "faqem/asset.hpp"
#include "render/rasterizer.hpp"
#include "result/picture_meter.hpp"

namespace faqem::detail {

/// Renders a model with other images, and attributes the errors to the images by the materials that pixels show.
class ImageErrorMeter {
public:
    /// Renders the model with perfect images.
    /// \param model    at least one face; its images are decoded unless they are pending
    /// \param pending  images of the model
    /// \param context  only its threads are used
    /// Complexity: O(faces + texels).
    ImageErrorMeter(const Asset& model, std::span<const PendingImage> pending, const RunContext& context);

    /// The errors that images add which replace the pending ones.
    /// \param shown  by pending image: its replacement; empty: the perfect one stays
    /// \return by pending image; nothing where pictures do not show it or it was not replaced. Pictures show base
    ///     colours and normal maps.
    /// Complexity: O(faces + texels).
    std::vector<std::optional<PictureDifference>> operator()(std::vector<Pixels> shown);

    /// Whether pictures with light are compared, since there are normal maps.
    bool has_lit_pictures() const { return !lit_.empty(); }

    /// By pending image: the share of the pictures' pixels with a material that has it.
    const std::vector<double>& shares() const { return shares_; }

private:
    std::vector<double> errors_by_material(const std::vector<render::Frame>& perfect,
                                           const std::vector<render::Frame>& frames) const;

    std::uint32_t threads_;
    render::Scene scene_;
    std::vector<render::Camera> cameras_;
    std::vector<render::Frame> unlit_, lit_;  // with perfect images; by camera
    std::uint64_t pixels_ = 0;                // that show the model
    std::vector<Index> images_;               // by pending image
    std::vector<double> shares_;
};

}  // namespace faqem::detail
