#include "cli/picture_error.hpp"

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

std::array<double, 3> shown_color(const Eigen::Vector4f& pixel) {
    std::array<double, 3> result{};
    for (int k = 0; k < 3; ++k) {
        const double linear = double{pixel[k]} + (1 - double{pixel[3]}) * grey_behind;
        result[static_cast<std::size_t>(k)] = detail::srgb_from_linear(std::clamp(linear, 0.0, 1.0));
    }
    return result;
}

// Sum over the pixels that show one of the models, and their number.
struct ErrorSum {
    double squares = 0;
    std::uint64_t pixels = 0;
};

ErrorSum frame_difference(const render::Frame& a, const render::Frame& b) {
    ErrorSum result;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (!(a.pixels[i][3] > 0) && !(b.pixels[i][3] > 0)) continue;
        const std::array<double, 3> first = shown_color(a.pixels[i]), second = shown_color(b.pixels[i]);
        for (std::size_t k = 0; k < 3; ++k) result.squares += (first[k] - second[k]) * (first[k] - second[k]);
        ++result.pixels;
    }
    return result;
}

}  // namespace

double picture_psnr(const PictureError& error) {
    const auto psnr = [](double mean_square) { return -10 * std::log10(mean_square + least_difference); };
    return (psnr(error.unlit) + psnr(error.lit)) / 2;
}

PictureMeter::PictureMeter(Asset source, const detail::Workers& workers)
    : threads_(workers.threads), shadings_{render::Shading::unlit} {
    if (has_normal_map(source)) shadings_.push_back(render::Shading::lit);
    source_ = render::make_scene(std::move(source));
    cameras_ = render::cameras_around(source_, "", picture_views);
    frames_ = render_all(source_);
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

std::vector<render::Frame> PictureMeter::render_all(const render::Scene& scene) const {
    const std::size_t views = cameras_.size();
    std::vector<render::Frame> result(shadings_.size() * views);
    detail::parallel_blocks(result.size(), 1, threads_, [&](std::size_t i, std::size_t) {
        result[i] = render::render(scene, cameras_[i % views], picture_size, shadings_[i / views],
                                   render::Edges::hidden);
    });
    return result;
}

PictureError PictureMeter::compare(const render::Scene& scene) const {
    const std::vector<render::Frame> frames = render_all(scene);
    std::array<ErrorSum, 2> sums;  // by shading
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const ErrorSum of_frame = frame_difference(frames_[i], frames[i]);
        ErrorSum& sum = sums[i / cameras_.size()];
        sum.squares += of_frame.squares;
        sum.pixels += of_frame.pixels;
    }
    const auto mean = [](const ErrorSum& sum) {
        return sum.squares / (3 * static_cast<double>(std::max<std::uint64_t>(sum.pixels, 1)));
    };
    return {mean(sums[0]), mean(sums[shadings_.size() - 1])};
}

}  // namespace faqem::cli
