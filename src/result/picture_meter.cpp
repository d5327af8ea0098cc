#include "result/picture_meter.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "asset/image/srgb.hpp"
#include "asset/scene/material_textures.hpp"
#include "faqem/error.hpp"
#include "render/views.hpp"

namespace faqem::detail {

namespace {

// Grey behind the model, so that neither dark nor bright silhouettes stand out.
constexpr double grey_behind = 0.2;  // linear

// A difference that is not seen: the PSNR is at most 90 dB.
constexpr double least_difference = 1e-9;

bool has_normal_map(const Asset& asset) {
    return std::any_of(asset.materials.begin(), asset.materials.end(),
                       [](const Material& m) { return bool(m.normal_texture) && !m.unlit; });
}

// Colour in sRGB before the grey, and alpha.
Eigen::Vector4f shown_pixel(const Eigen::Vector4f& pixel) {
    Eigen::Vector4f result = pixel;
    for (int k = 0; k < 3; ++k) {
        const double linear = double{pixel[k]} + (1 - double{pixel[3]}) * grey_behind;
        result[k] = static_cast<float>(srgb_from_linear(std::clamp(linear, 0.0, 1.0)));
    }
    return result;
}

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

// By image: its texture if materials have it in a role.
std::vector<Texture> textures(const Asset& model, std::span<const PendingImage> pending,
                              TextureRef Material::*role, TexelEncoding encoding) {
    std::vector<Texture> result(model.images.size());
    for (const Material& material : model.materials) {
        const TextureRef& texture = material.*role;
        if (!texture || texture.image >= result.size() || result[texture.image]) continue;
        const auto own = std::ranges::find(pending, texture.image, &PendingImage::image);
        result[texture.image] = own != pending.end() ? make_texture(own->pixels, encoding)
                                                     : decoded_texture(model.images[texture.image], encoding);
    }
    return result;
}

}  // namespace

std::vector<render::Frame> pictures(const render::Scene& scene, const std::vector<render::Camera>& cameras,
                                    render::Shading shading, std::uint32_t threads) {
    std::vector<render::Frame> result(cameras.size());
    const Eigen::Vector4f behind = shown_pixel(Eigen::Vector4f::Zero());
    parallel_blocks(cameras.size(), 1, threads, [&](std::size_t i, std::size_t) {
        result[i] = render::render(scene, cameras[i], picture_size, shading, render::Edges::hidden,
                                   render::Backs::hidden);
        for (Eigen::Vector4f& pixel : result[i].pixels) pixel = pixel.isZero(0) ? behind : shown_pixel(pixel);
    });
    return result;
}

double picture_psnr(const PictureDifference& error) {
    return (psnr(error.unlit, least_difference) + psnr(error.lit, least_difference)) / 2;
}

PictureMeter::PictureMeter(Asset source, const RunContext& context)
    : threads_(context.threads), has_normal_map_(has_normal_map(source)) {
    source_ = render::make_scene(std::move(source));
    cameras_ = render::cameras_around(source_, "", picture_views);
    unlit_ = pictures(source_, cameras_, render::Shading::unlit, threads_);
    if (has_normal_map_) lit_ = pictures(source_, cameras_, render::Shading::lit, threads_);
}

PictureDifference PictureMeter::operator()(Asset model) const {
    return compare(render::make_scene(std::move(model)));
}

render::Scene PictureMeter::with_source_textures(Asset model) const {
    model.images.clear();
    render::Scene scene = render::make_scene(std::move(model));
    scene.color_textures = source_.color_textures;
    scene.normal_maps = source_.normal_maps;
    return scene;
}

PictureDifference PictureMeter::with_source_images(Asset model) const {
    return compare(with_source_textures(std::move(model)));
}

double PictureMeter::lit_with_source_images(Asset model) {
    if (lit_.empty()) lit_ = pictures(source_, cameras_, render::Shading::lit, threads_);
    return difference(with_source_textures(std::move(model)), render::Shading::lit, lit_);
}

double PictureMeter::difference(const render::Scene& scene, render::Shading shading,
                                const std::vector<render::Frame>& of_source) const {
    const std::vector<render::Frame> own = pictures(scene, cameras_, shading, threads_);
    double squares = 0;
    std::uint64_t pixels = 0;  // that show one of the models
    for (std::size_t i = 0; i < own.size(); ++i) {
        double of_frame = 0;
        for (std::size_t p = 0; p < own[i].pixels.size(); ++p) {
            const Eigen::Vector4f &a = of_source[i].pixels[p], &b = own[i].pixels[p];
            if (!(a[3] > 0) && !(b[3] > 0)) continue;
            for (int k = 0; k < 3; ++k) {
                const double less = double{a[k]} - double{b[k]};
                of_frame += less * less;
            }
            ++pixels;
        }
        squares += of_frame;
    }
    return squares / (3 * static_cast<double>(std::max<std::uint64_t>(pixels, 1)));
}

PictureDifference PictureMeter::compare(const render::Scene& scene) const {
    const double unlit = difference(scene, render::Shading::unlit, unlit_);
    return {unlit, has_normal_map_ ? difference(scene, render::Shading::lit, lit_) : unlit};
}

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
    if (std::ranges::any_of(scene_.normal_maps, [](const Texture& map) { return bool(map); }))
        lit_ = pictures(scene_, cameras_, render::Shading::lit, threads_);

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
