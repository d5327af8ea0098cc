// The plugin for KTX2 images, the only file that uses Basis Universal's transcoder. The container is read here (Khronos
// KTX 2.0 specification, sections 3 and 5), so that the transcoder gets blocks of checked sizes only.

#include <transcoder/basisu_transcoder.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asset/image/codecs.hpp"
#include "asset/image/image_size.hpp"
#include "faqem/error.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t header_bytes = 80, level_bytes = 24, basis_lz_header_bytes = 20, picture_bytes = 20;
constexpr std::size_t uastc_block_bytes = 16;
constexpr std::uint64_t etc1s_model = 163, uastc_model = 166;  // colour models of the Khronos data format
constexpr std::uint64_t no_scheme = 0, basis_lz = 1, zstd = 2;

/// A picture of the level 0, in blocks of 4 x 4 pixels.
struct BlockGrid {
    std::uint32_t width, height, columns = (width + 3) / 4, rows = (height + 3) / 4;
};

/// Reads numbers and ranges of a file, which must be inside of it.
class ContainerReader {
public:
    ContainerReader(const Image& image, Bytes bytes) : image_(image), bytes_(bytes) {}

    /// A little-endian integer of `size` bytes at the position `at`.
    std::uint64_t number(std::uint64_t at, std::size_t size) const {
        std::uint64_t value = 0;
        const Bytes stored = range(at, size);
        for (std::size_t i = size; i-- > 0;) value = value << 8 | stored[i];
        return value;
    }

    /// The transcoder counts bytes in 32 bits.
    Bytes range(std::uint64_t at, std::uint64_t size) const {
        if (at > bytes_.size() || size > bytes_.size() - at || size > UINT32_MAX) fail("it is too short");
        return bytes_.subspan(at, size);
    }

    ContainerReader part(std::uint64_t at, std::uint64_t size) const { return {image_, range(at, size)}; }

    [[noreturn]] void fail(const char* why) const { fail_image(image_, std::string("is damaged: ") + why); }

    [[noreturn]] void refuse(const char* why) const {
        throw UnsupportedError(image_.uri, image_title(image_), std::string("is a KTX2 image ") + why);
    }

private:
    const Image& image_;
    Bytes bytes_;
};

std::uint32_t size_of(Bytes bytes) { return static_cast<std::uint32_t>(bytes.size()); }

/// \param global  the supercompression global data: a header, a description of each level, and the codebooks
void decode_etc1s(const ContainerReader& level, const ContainerReader& global, std::uint64_t levels,
                  const BlockGrid& grid, std::vector<std::uint8_t>& rgba) {
    std::uint64_t at = basis_lz_header_bytes + levels * picture_bytes;
    const auto next = [&](std::uint64_t length_at) {
        const Bytes own = global.range(at, global.number(length_at, 4));
        at += own.size();
        return own;
    };
    const Bytes endpoints = next(4), selectors = next(8), tables = next(12);
    basist::basisu_lowlevel_etc1s_transcoder transcoder;
    const auto count = [&](std::uint64_t count_at) {
        return static_cast<std::uint32_t>(global.number(count_at, 2));
    };
    if (!transcoder.decode_tables(tables.data(), size_of(tables)) ||
        !transcoder.decode_palettes(count(0), endpoints.data(), size_of(endpoints), count(2),
                                    selectors.data(), size_of(selectors)))
        global.fail("its codebooks cannot be decoded");
    const auto decode_slice = [&](std::uint64_t slice, bool is_alpha, basist::block_format format) {
        const Bytes blocks = level.range(global.number(slice, 4), global.number(slice + 4, 4));
        if (!transcoder.transcode_slice(rgba.data(), grid.columns, grid.rows, blocks.data(), size_of(blocks),
                                        format, 4, false, false, is_alpha, 0, grid.width, grid.height))
            level.fail("its blocks cannot be decoded");
    };
    const std::uint64_t color = basis_lz_header_bytes + 4, alpha = color + 8;
    const bool has_alpha = global.number(alpha + 4, 4) != 0;
    if (has_alpha) decode_slice(alpha, true, basist::block_format::cA32);
    decode_slice(color, false, has_alpha ? basist::block_format::cRGB32 : basist::block_format::cRGBA32);
}

void decode_uastc(const ContainerReader& level, Bytes stored, bool is_compressed, const BlockGrid& grid,
                  std::vector<std::uint8_t>& rgba) {
    std::vector<std::uint8_t> unpacked;
    const std::size_t size = uastc_block_bytes * grid.columns * grid.rows;
    if (is_compressed) {
        unpacked.resize(size);
        if (ZSTD_decompress(unpacked.data(), size, stored.data(), stored.size()) != size)
            level.fail("its blocks cannot be decompressed");
        stored = unpacked;
    }
    if (stored.size() != size) level.fail("it has another number of blocks than its size needs");
    basist::basisu_lowlevel_uastc_ldr_4x4_transcoder transcoder;
    if (!transcoder.transcode_slice(rgba.data(), grid.columns, grid.rows, stored.data(), size_of(stored),
                                    basist::block_format::cRGBA32, 4, false, true, grid.width, grid.height))
        level.fail("its blocks cannot be decoded");
}

Pixels decode_ktx2(const Image& image, const std::string&) {
    [[maybe_unused]] static const bool is_initialized = (basist::basisu_transcoder_init(), true);
    const ContainerReader file(image, image.encoded);
    const std::uint64_t width = file.number(20, 4), height = file.number(24, 4), levels = file.number(40, 4);
    const std::uint64_t scheme = file.number(44, 4);
    if (file.number(28, 4) != 0 || file.number(32, 4) > 1 || file.number(36, 4) != 1)
        file.refuse("of a cube, an array or a volume instead of a single picture");
    const std::uint64_t model = file.part(file.number(48, 4), file.number(52, 4)).number(12, 1);
    const bool is_etc1s = model == etc1s_model && scheme == basis_lz;
    const bool is_uastc = model == uastc_model && (scheme == no_scheme || scheme == zstd);
    if (file.number(12, 4) != 0 || (!is_etc1s && !is_uastc))
        file.refuse("of another encoding than ETC1S and UASTC");
    Pixels pixels = pixels_for(image, {width, height});
    if (levels < 1 || levels > static_cast<std::uint64_t>(std::bit_width(std::max(width, height))))
        file.fail("its number of levels is wrong");
    // Only the first level is decoded, but a file that lacks others is damaged.
    const auto level = [&](std::uint64_t i) {
        const std::uint64_t at = header_bytes + i * level_bytes;
        return file.range(file.number(at, 8), file.number(at + 8, 8));
    };
    for (std::uint64_t i = 1; i < levels; ++i) level(i);
    const Bytes first = level(0);
    const ContainerReader reader(image, first);
    const BlockGrid grid{pixels.width, pixels.height};
    if (is_etc1s)
        decode_etc1s(reader, file.part(file.number(64, 8), file.number(72, 8)), levels, grid, pixels.rgba);
    else
        decode_uastc(reader, first, scheme == zstd, grid, pixels.rgba);
    pixels.has_alpha = has_transparent_pixel(pixels);
    return pixels;
}

constexpr ImagePlugin plugin = {FAQEM_VERSION, decode_ktx2};

}  // namespace
}  // namespace faqem::detail

/// What ktx2_plugin() looks up.
extern "C" FAQEM_EXPORT const faqem::detail::ImagePlugin* faqem_image_plugin() {
    return &faqem::detail::plugin;
}
