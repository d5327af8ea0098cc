// Encoding of PNG files with libdeflate.

#include "asset/image/codecs.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace faqem::detail {
namespace {

using PngBytes = std::vector<std::uint8_t>;

constexpr int deflate_level = 6;
constexpr std::uint8_t palette_type = 3;
constexpr std::size_t max_chunk_bytes = std::size_t{1} << 30;  // lengths have 31 bits

/// Numbers of the filters of rows.
enum class PngFilter : std::uint8_t { none, sub, up, average, paeth };

/// Which channels are stored: 1 (grey), 2 (grey and alpha), 3 (RGB) or 4 (RGBA).
std::size_t needed_channels(const Pixels& pixels) {
    bool grey = true, opaque = true;
    for (std::size_t i = 0; i < pixels.rgba.size() && (grey || opaque); i += 4) {
        const std::uint8_t* const p = &pixels.rgba[i];
        grey &= p[0] == p[1] && p[1] == p[2];
        opaque &= p[3] == 255;
    }
    return (grey ? 1u : 3u) + (pixels.has_alpha && !opaque ? 1u : 0u);
}

/// Copies the channels that are stored from RGBA.
void pick_channels(const std::uint8_t* rgba, std::size_t pixels, std::size_t channels, std::uint8_t* to) {
    for (std::size_t i = 0; i < pixels; ++i, rgba += 4, to += channels) {
        to[0] = rgba[0];
        if (channels == 2) to[1] = rgba[3];
        if (channels >= 3) to[1] = rgba[1], to[2] = rgba[2];
        if (channels == 4) to[3] = rgba[3];
    }
}

int paeth(int left, int above, int corner) {
    const int to_left = std::abs(above - corner), to_above = std::abs(left - corner);
    const int to_corner = std::abs(left + above - 2 * corner);
    const int other = to_above <= to_corner ? above : corner;
    return ((to_left <= to_above) & (to_left <= to_corner)) ? left : other;
}

/// A row that is being filtered: samples of it and of the row above, with `step` zeros before the first one.
struct UnfilteredRow {
    std::uint8_t* samples;
    const std::uint8_t* above;
    std::size_t bytes, step;  ///< in the row, in a pixel
};

/// Filters a row (W3C PNG specification, "Filtering").
/// \tparam is_lossy  samples of colour may change by `max_difference`: they become what is decoded
/// \return the sum of the absolute values of the filtered bytes, as signed numbers
template <bool is_lossy, class Predict>
std::uint32_t apply_filter(const UnfilteredRow& row, [[maybe_unused]] int max_difference, std::uint8_t* to,
                           const Predict& predict) {
    [[maybe_unused]] const int interval = 2 * max_difference + 1;
    [[maybe_unused]] const bool has_alpha = row.step % 2 == 0;
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < row.bytes; ++i) {
        const int prediction =
            predict(*(row.samples + i - row.step), row.above[i], *(row.above + i - row.step));
        int difference = row.samples[i] - prediction;
        if constexpr (is_lossy) {
            const int up = difference < 0 ? -max_difference : max_difference;
            const int rounded = (difference + up) / interval * interval;
            const int value = prediction + rounded;
            const bool is_color = !has_alpha || i % row.step + 1 < row.step;
            if (is_color && value >= 0 && value <= 255) {
                difference = rounded;
                row.samples[i] = static_cast<std::uint8_t>(value);
            }
        }
        to[i] = static_cast<std::uint8_t>(difference);
        sum += static_cast<std::uint32_t>(std::abs(static_cast<std::int8_t>(to[i])));
    }
    return sum;
}

std::uint32_t filter_row(PngFilter filter, const UnfilteredRow& row, int max_difference, std::uint8_t* to) {
    const auto apply = [&](const auto& predict) {
        return max_difference > 0 ? apply_filter<true>(row, max_difference, to, predict)
                                  : apply_filter<false>(row, 0, to, predict);
    };
    if (filter == PngFilter::sub) return apply([](int left, int, int) { return left; });
    if (filter == PngFilter::up) return apply([](int, int up, int) { return up; });
    if (filter == PngFilter::average) return apply([](int left, int up, int) { return (left + up) / 2; });
    if (filter == PngFilter::paeth) return apply(paeth);
    return apply([](int, int, int) { return 0; });
}

/// The rows of an image, each after the number of its filter.
PngBytes filtered_rows(const Pixels& pixels, std::size_t channels, int max_difference) {
    const std::size_t bytes = channels * pixels.width;
    PngBytes rows((bytes + 1) * pixels.height);
    PngBytes original(channels + bytes), row(channels + bytes), above(channels + bytes),
        decoded(channels + bytes);
    PngBytes filtered(bytes);
    for (std::size_t y = 0; y < pixels.height; ++y) {
        pick_channels(&pixels.rgba[4 * y * pixels.width], pixels.width, channels, &original[channels]);
        std::uint8_t* const best = &rows[(bytes + 1) * y];
        std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
        using enum PngFilter;
        for (const PngFilter filter : {none, sub, up, average, paeth}) {
            row = original;
            const std::uint32_t sum = filter_row(filter, {&row[channels], &above[channels], bytes, channels},
                                                 max_difference, filtered.data());
            if (sum >= least) continue;
            least = sum;
            best[0] = static_cast<std::uint8_t>(filter);
            std::memcpy(best + 1, filtered.data(), bytes);
            decoded.swap(row);
        }
        decoded.swap(above);
    }
    return rows;
}

/// An image of few colours: the colours in the order of their first pixel, and unfiltered rows of indices.
struct PaletteRows {
    std::vector<std::array<std::uint8_t, 4>> colors;
    PngBytes rows;
};

/// Returns nothing if the image has more than 256 colours.
std::optional<PaletteRows> palette_rows(const Pixels& pixels) {
    using Color = std::array<std::uint8_t, 4>;
    PaletteRows result;
    result.rows.reserve((std::size_t{pixels.width} + 1) * pixels.height);
    std::unordered_map<std::uint32_t, std::uint8_t> indices;
    Color last = {};
    std::uint8_t index = 0;
    for (std::size_t i = 0; i < pixels.rgba.size(); i += 4) {
        if (i / 4 % pixels.width == 0) result.rows.push_back(0);  // no filter
        Color color;
        std::memcpy(color.data(), &pixels.rgba[i], 4);
        if (!pixels.has_alpha) color[3] = 255;
        if (i == 0 || color != last) {
            std::uint32_t key;
            std::memcpy(&key, color.data(), 4);
            const auto [found, is_new] =
                indices.emplace(key, static_cast<std::uint8_t>(result.colors.size()));
            if (is_new && result.colors.size() == 256) return {};
            if (is_new) result.colors.push_back(color);
            last = color;
            index = found->second;
        }
        result.rows.push_back(index);
    }
    return result;
}

/// Compressed bytes, in a buffer that may be larger and whose unused pages take no memory.
struct Deflated {
    std::unique_ptr<std::uint8_t[]> buffer;
    std::size_t size;
};

Deflated deflated(const PngBytes& bytes) {
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(deflate_level), libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), bytes.size());
    Deflated result{std::make_unique_for_overwrite<std::uint8_t[]>(bound), 0};
    result.size =
        libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), result.buffer.get(), bound);
    return result;
}

void append_big_endian(PngBytes& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void append_chunk(PngBytes& file, std::string_view type, std::span<const std::uint8_t> data) {
    append_big_endian(file, static_cast<std::uint32_t>(data.size()));
    const std::size_t checked = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), data.begin(), data.end());
    append_big_endian(file, libdeflate_crc32(0, &file[checked], file.size() - checked));
}

void append_palette(PngBytes& file, const std::vector<std::array<std::uint8_t, 4>>& colors) {
    PngBytes rgb, alpha;
    for (const auto& color : colors) {
        rgb.insert(rgb.end(), color.begin(), color.begin() + 3);
        alpha.push_back(color[3]);
    }
    while (!alpha.empty() && alpha.back() == 255) alpha.pop_back();  // the default
    append_chunk(file, "PLTE", rgb);
    if (!alpha.empty()) append_chunk(file, "tRNS", alpha);
}

}  // namespace

Image write_png(const Pixels& pixels, const std::string& name, int max_difference) {
    static constexpr std::array<std::uint8_t, 5> types = {0, 0, 4, 2, 6};  // of the number of channels
    const std::size_t channels = needed_channels(pixels);
    std::uint8_t type = types[channels];
    Deflated data = deflated(filtered_rows(pixels, channels, max_difference));
    std::optional<PaletteRows> palette;
    if (channels > 1 && max_difference == 0) palette = palette_rows(pixels);
    if (palette) {
        Deflated indices = deflated(palette->rows);
        if (indices.size + 4 * palette->colors.size() < data.size) {
            data = std::move(indices);
            type = palette_type;
        }
    }

    PngBytes file;
    file.reserve(data.size + 2048);
    file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    PngBytes header;
    append_big_endian(header, pixels.width);
    append_big_endian(header, pixels.height);
    header.insert(header.end(), {8, type, 0, 0, 0});  // bits, colours, deflate, filters, no interlacing
    append_chunk(file, "IHDR", header);
    if (type == palette_type) append_palette(file, palette->colors);
    for (std::size_t at = 0; at < data.size; at += max_chunk_bytes)
        append_chunk(file, "IDAT", {&data.buffer[at], std::min(max_chunk_bytes, data.size - at)});
    append_chunk(file, "IEND", {});
    return {name, "image/png", std::move(file), {}};
}

}  // namespace faqem::detail
