#pragma once
/// \file
/// How far pictures of a result differ from those of its source, and what the error of each image adds to that.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/texture/pending_images.hpp"
#include "bake/texture/picture_difference.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "render/rasterizer.hpp"

namespace faqem::detail {

/// Number of pictures, and their side in pixels.
inline constexpr std::uint32_t picture_views = 6, picture_size = 256;

/// Pictures of a scene in sRGB, and before grey where the model does not cover them, by camera.
/// Complexity: O(faces + pixels) for each, on several threads.
std::vector<render::Frame> pictures(const render::Scene& scene, const std::vector<render::Camera>& cameras,
                                    render::Shading shading, std::uint32_t threads);

/// PSNR in dB, the mean of unlit and lit pictures; 90 if nothing differs.
double picture_psnr(const PictureDifference& error);

/// Renders models from the same cameras as their source.
class PictureMeter {
public:
    /// Renders the source: six views around it of 256 x 256 pixels, unlit and, if a material has a normal map, lit.
    /// \param source   at least one face; its images are decoded and kept
    /// \param context  only its threads are used
    /// Complexity: O(faces + texels of the source).
    PictureMeter(Asset source, const RunContext& context);

    /// Compares a model with the source. An image that cannot be decoded is drawn white in both.
    PictureDifference operator()(Asset model) const;

    /// Compares a model that has the images of the source, with the same indices. Does not decode them again; those
    /// that the model holds are ignored.
    PictureDifference with_source_images(Asset model) const;

    /// Mean squared difference of lit pictures, also where the others are unlit. Otherwise as with_source_images().
    double lit_with_source_images(Asset model);

private:
    render::Scene with_source_textures(Asset model) const;
    PictureDifference compare(const render::Scene& scene) const;
    double difference(const render::Scene& scene, render::Shading shading,
                      const std::vector<render::Frame>& of_source) const;

    std::uint32_t threads_;
    render::Scene source_;
    bool has_normal_map_;
    std::vector<render::Camera> cameras_;
    std::vector<render::Frame> unlit_, lit_;  // of the source, by camera; `lit_` is empty until it is needed
};

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
