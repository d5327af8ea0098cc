#include "bake/texture/image_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "asset/image/codecs.hpp"
#include "asset/image/combine.hpp"
#include "asset/image/rgba_lanes.hpp"

namespace faqem::detail {
namespace {

// Steps of JPEGs that are tried, relative to the one that gives the wanted error where all coefficients are rounded
// evenly. Where most of them are 0, a coarser one would still be within the limit, but its blocks would be visible.
constexpr double coarsest_step = 2.25, finest_step = 0.35, step_ratio = 0.85;

// By how much values of a PNG may change: more would be visible as stripes on smooth surfaces.
constexpr int max_png_difference = 6;

// Qualities of lossy WebP: each has about webp_step dB more than the one before. An image is accepted with less than webp_slack
// above the limit.
constexpr std::array<int, 28> webp_qualities = {40, 47, 54, 60, 65, 69, 73, 76, 79, 82, 83, 84, 85, 86,
                                                87, 88, 89, 90, 91, 92, 93, 94, 95, 96, 97, 98, 99, 100};
constexpr double webp_step = 0.55, webp_slack = 0.8;

// Indices of them: the one where colours usually have 40 dB; the last one with which a WebP is smaller than a JPEG and than with
// more texels; and the last one that may be smaller.
constexpr int usual_webp = 9, last_easy_webp = 12, last_small_webp = 21;

// Effort of lossy WebP: at the usual one, three times as long gives 5% fewer bytes.
constexpr int webp_effort = 2;

// Near-lossless WebP that changes values by up to 4: normals keep the resolution that lossy WebP halves.
constexpr int near_lossless_level = 40;

// Lossless encodings are tried where a sample of so many rows says that they may be the smallest. The sample is taken as a PNG
// first: WebP has more than 40% of its bytes.
constexpr std::uint32_t sample_rows = 64, sample_places = 8;
constexpr double most_png_bytes = 2.5, most_webp_bytes = 1.25;

// A smaller side would not have a texel for every chart of a simple model.
constexpr std::uint32_t min_side = 8;

// With fewer texels, a result may have this many times the bytes: texels take memory wherever it is shown.
constexpr double bytes_for_fewer_texels = 1.1;

// Side of the blocks of ImageQuality, texels.
constexpr std::uint32_t block_side = 8;

// PSNR of colours if BakeOptions::image_quality is unset.
constexpr double usual_quality = 40;

// By how many dB a block may be worse than the whole image.
constexpr double block_allowance = 15;

// PSNR of an image above that of the pictures, so that it adds little to their error. The pictures are measured at few
// points, most of the error is at silhouettes.
constexpr double quality_above_pictures = 8;

// Bounds of quality_change(). Images that are worse by more would be seen to be in closer views.
constexpr double most_better = 4, most_worse = 2;

// By how many dB an image of roughness and the like may be worse than one of colours, and one of the normals of a
// rough surface. On glossy ones an error of normals is as visible as one of colours.
constexpr double data_allowance = 4;

// Least PSNR of such an image unless colours may be worse too: 3% of the range.
constexpr double least_data_psnr = 30;

// Rows of an image with fewer texels, interpolated to the width of another one. The last two are kept, and the first one,
// which may follow the last.
class StretchedRows {
public:
    StretchedRows(const Pixels& pixels, std::uint32_t width, bool repeats)
        : pixels_(pixels), columns_(taps_of(pixels.width, width, repeats)) {}

    const std::vector<RgbaLanes>& at(std::uint32_t y) {
        Row& row = rows_[y == 0 ? 2 : y % 2];
        if (row.y == y) return row.texels;
        row = {y, std::move(row.texels)};
        row.texels.clear();
        const std::uint8_t* const from = &pixels_.rgba[4 * (std::size_t{y} * pixels_.width)];
        for (const auto& [first, second, share] : columns_) {
            const auto s = static_cast<float>(share);
            row.texels.push_back(to_lanes(from + 4 * std::size_t{first}) * (1 - s) +
                                 to_lanes(from + 4 * std::size_t{second}) * s);
        }
        return row.texels;
    }

private:
    struct Row {
        std::uint32_t y = no_index;
        std::vector<RgbaLanes> texels = {};
    };
    const Pixels& pixels_;
    std::vector<Tap> columns_;
    std::array<Row, 3> rows_;
};

// An image that is being encoded with a loss.
struct LossyEncoding {
    const Pixels& original;
    const Pixels& pixels;  // may have fewer texels
    std::span<const std::uint8_t> known;
    ImageQuality quality;
    std::array<bool, 2> repeats;
    const RunContext& context;

    ImageQuality quality_of(const Image& image) const {
        return shown_quality(original, decode(image), known, repeats);
    }
    bool allows(const Image& image) const { return is_within(quality_of(image), quality); }

    // The first of some levels, from coarse to fine, with which encode() gives a sufficient image, which it returns, and
    // its index; nothing if none does.
    template <class Encode>
    std::optional<std::pair<Image, std::size_t>> least(std::size_t levels, const Encode& encode) const {
        std::optional<std::pair<Image, std::size_t>> best;
        std::size_t begin = 0, end = levels;
        while (begin < end) {
            context.check_now();
            const std::size_t middle = begin + (end - begin) / 2;
            if (Image image = encode(middle); allows(image)) {
                best.emplace(std::move(image), middle);
                end = middle;
            } else {
                begin = middle + 1;
            }
        }
        return best;
    }
};

void keep_smaller(std::optional<Image>& best, std::optional<Image> other) {
    if (other && (!best || other->encoded.size() < best->encoded.size())) best = std::move(other);
}

// JpegRounding::step values that are tried for a PSNR, from coarse to fine.
std::vector<std::uint32_t> jpeg_steps(double quality) {
    const double even = 255 * std::sqrt(12 * mean_square_of(quality));  // uniform errors of up to half a step
    std::vector<std::uint32_t> result;
    for (double factor = coarsest_step; factor >= finest_step; factor *= step_ratio) {
        const auto step = static_cast<std::uint32_t>(std::clamp(std::round(even * factor), 1.0, 100.0));
        if (result.empty() || result.back() != step) result.push_back(step);
    }
    return result;
}

// The smallest sufficient JPEG. Chroma of half the resolution needs finer steps for the same error.
std::optional<Image> smallest_jpeg(const LossyEncoding& lossy, const std::string& name, Content content) {
    const std::vector<std::uint32_t> steps = jpeg_steps(lossy.quality.whole);
    const auto encode = [&](Chroma chroma) {
        return [&, chroma](std::size_t i) { return write_jpeg(lossy.pixels, name, {steps[i], chroma}); };
    };
    std::size_t count = steps.size();
    std::optional<Image> best;
    if (content == Content::color) {
        if (auto half = lossy.least(count, encode(Chroma::half))) {
            best = std::move(half->first);
            count = half->second + 1;
        }
    }
    if (auto full = lossy.least(count, encode(Chroma::full))) keep_smaller(best, std::move(full->first));
    return best;
}

// The most that values of a PNG may change for a PSNR: if differences are distributed evenly.
int png_difference(double quality, std::size_t channels) {
    const double mean_square = 255.0 * 255 * mean_square_of(quality) * static_cast<double>(channels) / 3;
    const double interval = std::sqrt(12 * mean_square + 1);
    return static_cast<int>(std::clamp((interval - 1) / 2, 0.0, double{max_png_difference}));
}

// A PNG with the largest sufficient differences; nothing if only a lossless one is sufficient.
std::optional<Image> near_lossless_png(const LossyEncoding& lossy, const std::string& name) {
    const int most = png_difference(lossy.quality.whole, lossy.pixels.has_alpha ? 4 : 3);
    auto found = lossy.least(static_cast<std::size_t>(most), [&](std::size_t i) {
        return write_png(lossy.pixels, name, most - static_cast<int>(i));
    });
    return found ? std::optional(std::move(found->first)) : std::nullopt;
}

// A sufficient lossy WebP of about the least quality and the index of this; no image if there is none. The error of a quality
// tells about which one to try next, which takes two or three encodings.
// \param last  index of the highest quality
std::pair<std::optional<Image>, int> lossy_webp(const LossyEncoding& lossy, const std::string& name,
                                                int last) {
    std::optional<Image> best;
    int begin = 0, end = last + 1, i = usual_webp, jump = 0;
    while (begin < end) {
        lossy.context.check_now();
        const int level = webp_qualities[static_cast<std::size_t>(i)];
        Image image = encode_webp(lossy.pixels, name, {.level = level, .effort = webp_effort});
        const ImageQuality shown = lossy.quality_of(image);
        const double surplus = std::min(shown.whole - lossy.quality.whole, shown.block - lossy.quality.block);
        const int steps = static_cast<int>(std::floor(std::clamp(surplus / webp_step, -30.0, 30.0)));
        if (is_within(shown, lossy.quality)) {
            best = std::move(image);
            end = i;
            if (!(surplus >= webp_slack)) break;
            i = std::max(i - steps, begin);
        } else {
            begin = i + 1;
            jump = std::max(2 * jump, -steps);  // the difference of colours with half the resolution stays
            if (i + jump > last && last == last_small_webp) break;
            i = std::min(i + jump, end - 1);
        }
    }
    return {std::move(best), end};
}

// Rows from several places of an image, or all of a small one.
Pixels sample_of(const Pixels& pixels) {
    if (pixels.height <= sample_rows) return pixels;
    Pixels sample{pixels.width, sample_rows, {}, pixels.has_alpha};
    const std::size_t row = std::size_t{4} * pixels.width;
    for (std::size_t y = 0; y < sample_rows; ++y) {
        constexpr std::size_t run = sample_rows / sample_places;
        const std::size_t from = y / run * (pixels.height / sample_places) + y % run;
        const auto first = pixels.rgba.begin() + static_cast<std::ptrdiff_t>(from * row);
        sample.rgba.insert(sample.rgba.end(), first, first + static_cast<std::ptrdiff_t>(row));
    }
    return sample;
}

// The smallest of the encodings that are tried, and whether it will be smaller than one with more texels. Lossless ones are
// tried where no other is sufficient, and if `tries_lossless`.
std::pair<Image, bool> smallest_at(const LossyEncoding& lossy, const std::string& name, Content content,
                                   const ImageLimits& limits, bool tries_lossless) {
    const Pixels& pixels = lossy.pixels;
    std::optional<Image> best;
    bool is_easy = false;
    if (limits.tries_webp) {
        const bool may_be_jpeg = limits.tries_core && !pixels.has_alpha;
        const int last = may_be_jpeg ? last_small_webp : static_cast<int>(webp_qualities.size()) - 1;
        auto [image, quality] = lossy_webp(lossy, name, last);
        is_easy = image && quality <= last_easy_webp;
        best = std::move(image);
    }
    if (limits.tries_core && !is_easy)
        keep_smaller(best,
                     pixels.has_alpha ? near_lossless_png(lossy, name) : smallest_jpeg(lossy, name, content));
    const Pixels sample = sample_of(pixels);
    // Whether an encoding may have at most so many times the bytes of the best one.
    const auto may_be_small = [&](double ratio, const auto& encode) {
        if (!best) return true;
        const double rows = static_cast<double>(pixels.height) / sample.height;
        return static_cast<double>(encode(sample).encoded.size()) * rows <=
               ratio * static_cast<double>(best->encoded.size());
    };
    const auto png = [&](const Pixels& of) { return encode_png(of, name); };
    const bool may_be_lossless = may_be_small(most_png_bytes, png);
    const auto try_webp = [&](WebpMode mode) {
        const auto webp = [&](const Pixels& of) {
            return encode_webp(of, name, {.mode = mode, .level = near_lossless_level});
        };
        if (!limits.tries_webp || !may_be_lossless) return;
        if (pixels.height > sample.height && !may_be_small(most_webp_bytes, webp)) return;
        Image image = webp(pixels);
        if (mode == WebpMode::lossless || lossy.allows(image)) keep_smaller(best, std::move(image));
    };
    try_webp(WebpMode::near_lossless);
    if (tries_lossless || !best) {
        if (limits.tries_core && may_be_lossless) keep_smaller(best, png(pixels));
        try_webp(WebpMode::lossless);
    }
    return {*std::move(best), is_easy};
}

}  // namespace

ImageQuality least_quality(const BakeOptions& bake, TextureContent content, double roughness, double change) {
    const double colors = bake.image_quality.value_or(usual_quality);
    double usual = colors;
    if (!is_color(content)) {
        const double allowance = data_allowance * (content == TextureContent::normal ? roughness : 1);
        usual = std::min(colors, std::max(colors - allowance, least_data_psnr));
    }
    return {bake.image_quality ? usual : usual + change, usual - block_allowance};
}

double quality_change(const std::optional<PictureDifference>& pictures, TextureContent content) {
    if (!pictures) return 0;
    const double most = is_color(content) ? std::min(pictures->unlit, pictures->lit) : pictures->lit;
    const double shown = psnr(most, invisible_difference);
    if (!std::isfinite(shown)) return 0;
    return std::clamp(shown + quality_above_pictures - usual_quality, -most_worse, most_better);
}

ImageQuality shown_quality(const Pixels& original, const Pixels& shown, std::span<const std::uint8_t> known,
                           std::array<bool, 2> repeats) {
    StretchedRows stretched(shown, original.width, repeats[0]);
    const std::vector<Tap> rows = taps_of(shown.height, original.height, repeats[1]);
    const std::size_t channels = original.has_alpha ? 4 : 3;
    std::vector<double> blocks((original.width + block_side - 1) / block_side);  // of a row of blocks
    double sum = 0, worst = 0;
    std::uint64_t count = 0;
    for (std::uint32_t y = 0; y < original.height; ++y) {
        if (y % block_side == 0) std::fill(blocks.begin(), blocks.end(), 0.0);
        const auto& [first, second, share] = rows[y];
        const auto t = static_cast<float>(share);
        const RgbaLanes *const upper = stretched.at(first).data(), *const lower = stretched.at(second).data();
        for (std::uint32_t x = 0; x < original.width;) {
            double in_row = 0;
            for (const std::uint32_t end = std::min(x + block_side, original.width); x < end; ++x) {
                const std::size_t at = std::size_t{y} * original.width + x;
                if (!known[at]) continue;
                const std::uint8_t* const texel = &original.rgba[4 * at];
                const RgbaLanes difference = upper[x] * (1 - t) + lower[x] * t - to_lanes(texel);
                RgbaLanes squares = difference * difference;
                if (original.has_alpha) {
                    const float alpha = static_cast<float>(texel[3]) / 255;
                    squares *= RgbaLanes{alpha, alpha, alpha, 1};
                } else {
                    squares[3] = 0;
                }
                in_row += squares[0] + squares[1] + squares[2] + squares[3];
                ++count;
            }
            blocks[(x - 1) / block_side] += in_row;
        }
        if (y % block_side + 1 < block_side && y + 1 < original.height) continue;
        for (const double block : blocks) {
            sum += block;
            worst = std::max(worst, block);
        }
    }
    const double n = 255.0 * 255 * static_cast<double>(channels);
    return {psnr(sum / (n * static_cast<double>(std::max<std::uint64_t>(count, 1)))),
            psnr(worst / (n * block_side * block_side))};
}

bool is_within(const ImageQuality& shown, const ImageQuality& least) {
    return shown.whole >= least.whole && shown.block >= least.block;
}

bool can_be_halved(const Pixels& pixels) {
    return pixels.width % 2 == 0 && pixels.height % 2 == 0 && std::min(pixels.width, pixels.height) > 1;
}

Pixels halved(const Pixels& pixels) {
    Pixels result{pixels.width / 2, pixels.height / 2, {}, pixels.has_alpha};
    result.rgba.resize(std::size_t{4} * result.width * result.height);
    const std::size_t row = std::size_t{4} * pixels.width;
    for (std::uint32_t y = 0; y < result.height; ++y) {
        for (std::uint32_t x = 0; x < result.width; ++x) {
            const std::uint8_t* const from = &pixels.rgba[2 * y * row + std::size_t{8} * x];
            for (std::size_t k = 0; k < 4; ++k) {
                const unsigned total = from[k] + from[4 + k] + from[row + k] + from[row + 4 + k];
                result.rgba[4 * (std::size_t{y} * result.width + x) + k] =
                    static_cast<std::uint8_t>((total + 2) / 4);
            }
        }
    }
    return result;
}

Image encode_smallest(const Pixels& pixels, std::span<const std::uint8_t> known, const std::string& name,
                      Content content, const ImageLimits& limits, const RunContext& context) {
    std::vector<Pixels> smaller;  // by number of halvings, without `pixels` itself
    while (limits.may_shrink) {
        const Pixels& last = smaller.empty() ? pixels : smaller.back();
        if (!can_be_halved(last) || std::min(last.width, last.height) / 2 < min_side) break;
        context.check_now();
        Pixels next = halved(last);
        if (!is_within(shown_quality(pixels, next, known, limits.repeats), limits.quality)) break;
        smaller.push_back(std::move(next));
    }
    const auto encoded = [&](const Pixels& at, bool tries_lossless) {
        return smallest_at({pixels, at, known, limits.quality, limits.repeats, context}, name, content,
                           limits, tries_lossless);
    };
    auto [best, is_easy] = encoded(smaller.empty() ? pixels : smaller.back(), true);
    if (smaller.empty() || is_easy) return std::move(best);
    // Lossless encodings are tried there too if one may have been the smallest: images with few colours stay so at
    // any resolution.
    const bool was_lossless = best.mime_type != "image/jpeg";
    Image other = encoded(smaller.size() == 1 ? pixels : smaller[smaller.size() - 2], was_lossless).first;
    if (bytes_for_fewer_texels * static_cast<double>(other.encoded.size()) <
        static_cast<double>(best.encoded.size()))
        best = std::move(other);
    return std::move(best);
}

}  // namespace faqem::detail
