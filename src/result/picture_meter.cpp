#include "result/picture_meter.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "asset/image/srgb.hpp"
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

}  // namespace

std::vector<render::Frame> pictures(const render::Scene& scene, const std::vector<render::Camera>& cameras,
                                    render::Shading shading, std::uint32_t threads) {
    std::vector<render::Frame> result(cameras.size());
    const Eigen::Vector4f behind = shown_pixel(Eigen::Vector4f::Zero());
    parallel_blocks(cameras.size(), 1, threads, [&](std::size_t i, std::size_t) {
        result[i] = render::render(scene, cameras[i], picture_size, shading, render::Edges::hidden);
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

template <class Use>
auto PictureMeter::use_source_images(Asset model, const Use& use) {
    model.images.clear();
    render::Scene scene = render::make_scene(std::move(model));
    const auto exchange_textures = [&] {
        std::swap(scene.color_textures, source_.color_textures);
        std::swap(scene.normal_maps, source_.normal_maps);
    };
    exchange_textures();
    const auto result = use(scene);
    exchange_textures();
    return result;
}

PictureDifference PictureMeter::with_source_images(Asset model) {
    return use_source_images(std::move(model), [&](const render::Scene& scene) { return compare(scene); });
}

double PictureMeter::lit_with_source_images(Asset model) {
    if (lit_.empty()) lit_ = pictures(source_, cameras_, render::Shading::lit, threads_);
    return use_source_images(std::move(model), [&](const render::Scene& scene) {
        return difference(scene, render::Shading::lit, lit_);
    });
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

}  // namespace faqem::detail
