#include "result/image_error.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "asset/scene/material_textures.hpp"
#include "faqem/error.hpp"
#include "render/views.hpp"

namespace faqem::detail {

namespace {

using render::Texture;

Texture make_texture(Pixels pixels, TexelEncoding encoding) {
    return std::make_shared<const MipImage>(std::move(pixels), encoding);
}

// The texture of an image that stays as it is; null, which is drawn white, if it cannot be decoded.
Texture decoded_texture(const Image& image, TexelEncoding encoding) {
    try {
        return make_texture(decode(image), encoding);
    } catch (const Error&) {
        return nullptr;
    }
}

// Marks the images that materials have as base colours, or as normal maps.
std::vector<std::uint8_t> images_in_role(const Asset& model, TextureRef Material::*role) {
    std::vector<std::uint8_t> result(model.images.size(), 0);
    for (const Material& material : model.materials) {
        const TextureRef& texture = material.*role;
        if (texture && texture.image < result.size()) result[texture.image] = 1;
    }
    return result;
}

std::vector<Texture> textures(const Asset& model, std::span<const PendingImage> pending,
                              TextureRef Material::*role, TexelEncoding encoding) {
    const std::vector<std::uint8_t> is_used = images_in_role(model, role);
    std::vector<std::uint8_t> is_pending(is_used.size(), 0);
    std::vector<Texture> result(is_used.size());
    for (const PendingImage& image : pending) {
        is_pending[image.image] = 1;
        if (is_used[image.image]) result[image.image] = make_texture(image.pixels, encoding);
    }
    for (std::size_t i = 0; i < result.size(); ++i)
        if (is_used[i] && !is_pending[i]) result[i] = decoded_texture(model.images[i], encoding);
    return result;
}

bool has_any(const std::vector<Texture>& all) {
    return std::any_of(all.begin(), all.end(), [](const Texture& texture) { return bool(texture); });
}

}  // namespace

ImageErrorMeter::ImageErrorMeter(const Asset& model, std::span<const PendingImage> pending,
                                 const RunContext& context)
    : threads_(context.threads) {
    std::vector<Texture> colors =
        textures(model, pending, &Material::base_color_texture, TexelEncoding::color_and_data_alpha);
    std::vector<Texture> normals = textures(model, pending, &Material::normal_texture, TexelEncoding::data);
    Asset shown = model;
    shown.images.clear();
    scene_ = render::make_scene(std::move(shown));
    scene_.color_textures = std::move(colors);
    scene_.normal_maps = std::move(normals);
    cameras_ = render::cameras_around(scene_, "", picture_views);
    unlit_ = pictures(scene_, cameras_, render::Shading::unlit, threads_);
    if (has_any(scene_.normal_maps)) lit_ = pictures(scene_, cameras_, render::Shading::lit, threads_);

    std::vector<std::uint64_t> pixels(model.materials.size() + 1, 0);  // by material
    for (const render::Frame& frame : unlit_) {
        for (const Index material : frame.materials) {
            if (material == no_index) continue;
            ++pixels[material];
            ++pixels_;
        }
    }
    for (const PendingImage& image : pending) {
        images_.push_back(image.image);
        std::uint64_t own = 0;
        for (std::size_t m = 0; m < model.materials.size(); ++m)
            if (uses_image(model.materials[m], image.image)) own += pixels[m];
        shares_.push_back(static_cast<double>(own) /
                          static_cast<double>(std::max<std::uint64_t>(pixels_, 1)));
    }
}

std::vector<double> ImageErrorMeter::errors_by_material(const std::vector<render::Frame>& perfect,
                                                        const std::vector<render::Frame>& frames) const {
    std::vector<double> result(scene_.asset.materials.size() + 1, 0);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        for (std::size_t k = 0; k < frames[i].pixels.size(); ++k) {
            // With alpha masks, one of the pictures may show what is behind the other's material.
            const Index shown = perfect[i].materials[k];
            const Index material = shown != no_index ? shown : frames[i].materials[k];
            if (material == no_index) continue;
            result[material] +=
                (perfect[i].pixels[k] - frames[i].pixels[k]).head<3>().cast<double>().squaredNorm();
        }
    }
    for (double& sum : result) sum /= 3 * static_cast<double>(std::max<std::uint64_t>(pixels_, 1));
    return result;
}

std::vector<std::optional<PictureDifference>> ImageErrorMeter::operator()(std::vector<Pixels> shown) {
    std::vector<std::optional<PictureDifference>> result(images_.size());
    // Errors of one role: the other has perfect images, so that they are not mixed up.
    const auto measure = [&](std::vector<Texture>& all, TextureRef Material::*role, render::Shading shading,
                             TexelEncoding encoding, const PictureDifference& weights) {
        std::vector<std::pair<std::size_t, Texture>> replaced;
        for (std::size_t i = 0; i < images_.size(); ++i) {
            if (shown[i].rgba.empty() || !all[images_[i]]) continue;
            replaced.emplace_back(i, make_texture(shown[i], encoding));
            std::swap(all[images_[i]], replaced.back().second);
        }
        if (replaced.empty()) return;
        const bool is_lit = shading == render::Shading::lit;
        const std::vector<double> errors =
            errors_by_material(is_lit ? lit_ : unlit_, pictures(scene_, cameras_, shading, threads_));
        for (auto& [i, perfect] : replaced) {
            double sum = 0;
            for (std::size_t m = 0; m < scene_.asset.materials.size(); ++m)
                if ((scene_.asset.materials[m].*role).image == images_[i]) sum += errors[m];
            if (!result[i]) result[i].emplace();
            *result[i] += weights * sum;
            std::swap(all[images_[i]], perfect);
        }
    };
    // Light changes an error of colours little.
    measure(scene_.color_textures, &Material::base_color_texture, render::Shading::unlit,
            TexelEncoding::color_and_data_alpha, {1, 1});
    measure(scene_.normal_maps, &Material::normal_texture, render::Shading::lit, TexelEncoding::data, {0, 1});
    return result;
}

}  // namespace faqem::detail
