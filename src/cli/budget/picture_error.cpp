#include "cli/budget/picture_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "asset/image/srgb.hpp"
#include "render/views.hpp"

namespace faqem::cli {

namespace {

constexpr std::uint32_t picture_views = 6, picture_size = 320;

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
        result[k] = static_cast<float>(detail::srgb_from_linear(std::clamp(linear, 0.0, 1.0)));
    }
    return result;
}

// Sum over the pixels that show one of the models, and their number.
struct ErrorSum {
    double squares = 0;
    std::uint64_t pixels = 0;
};

// \param shown  pixels of the source after shown_pixel()
ErrorSum frame_difference(const render::Frame& shown, const render::Frame& frame) {
    ErrorSum result;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        if (!(shown.pixels[i][3] > 0) && !(frame.pixels[i][3] > 0)) continue;
        const Eigen::Vector4f pixel = shown_pixel(frame.pixels[i]);
        for (int k = 0; k < 3; ++k) {
            const double difference = double{shown.pixels[i][k]} - double{pixel[k]};
            result.squares += difference * difference;
        }
        ++result.pixels;
    }
    return result;
}

}  // namespace

double picture_psnr(const PictureError& error) {
    const auto psnr = [](double mean_square) { return -10 * std::log10(mean_square + least_difference); };
    return (psnr(error.unlit) + psnr(error.lit)) / 2;
}

template <class Use>
void PictureMeter::for_each_frame(const render::Scene& scene, const Use& use) const {
    const std::size_t views = cameras_.size();
    detail::parallel_blocks(frames_.size(), 1, threads_, [&](std::size_t i, std::size_t) {
        use(i, render::render(scene, cameras_[i % views], picture_size, shadings_[i / views],
                              render::Edges::hidden));
    });
}

PictureMeter::PictureMeter(Asset source, const detail::Workers& workers)
    : threads_(workers.threads), shadings_{render::Shading::unlit} {
    if (has_normal_map(source)) shadings_.push_back(render::Shading::lit);
    source_ = render::make_scene(std::move(source));
    cameras_ = render::cameras_around(source_, "", picture_views);
    frames_.resize(shadings_.size() * cameras_.size());
    for_each_frame(source_, [&](std::size_t i, render::Frame frame) {
        frames_[i] = std::move(frame);
        for (Eigen::Vector4f& pixel : frames_[i].pixels) pixel = shown_pixel(pixel);
    });
}

PictureError PictureMeter::operator()(Asset model) const {
    return compare(render::make_scene(std::move(model)));
}

PictureError PictureMeter::with_source_images(Asset model) {
    model.images.clear();
    render::Scene scene = render::make_scene(std::move(model));
    const auto exchange_textures = [&] {
        std::swap(scene.color_textures, source_.color_textures);
        std::swap(scene.normal_maps, source_.normal_maps);
    };
    exchange_textures();
    const PictureError result = compare(scene);
    exchange_textures();
    return result;
}

PictureError PictureMeter::compare(const render::Scene& scene) const {
    std::vector<ErrorSum> by_frame(frames_.size());
    for_each_frame(scene, [&](std::size_t i, const render::Frame& frame) {
        by_frame[i] = frame_difference(frames_[i], frame);
    });
    std::array<ErrorSum, 2> sums;  // by shading
    for (std::size_t i = 0; i < by_frame.size(); ++i) {
        ErrorSum& sum = sums[i / cameras_.size()];
        sum.squares += by_frame[i].squares;
        sum.pixels += by_frame[i].pixels;
    }
    const auto mean = [](const ErrorSum& sum) {
        return sum.squares / (3 * static_cast<double>(std::max<std::uint64_t>(sum.pixels, 1)));
    };
    return {mean(sums[0]), mean(sums[shadings_.size() - 1])};
}

}  // namespace faqem::cli
