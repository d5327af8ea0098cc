#include "asset/image/png_chunks.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace faqem::detail {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t signature_bytes = 8, frame_bytes = 12;  // of a chunk: length, type and checksum

/// Ancillary chunks that a decoder may use for the pixels, or of which there is only one.
constexpr std::array<std::string_view, 8> kept_chunks = {"tRNS", "gAMA", "cHRM", "sRGB",
                                                         "iCCP", "sBIT", "bKGD", "pHYs"};

std::string_view chunk_type(Bytes chunk) { return {reinterpret_cast<const char*>(chunk.data()) + 4, 4}; }

/// Size of the chunk at the start of `rest`, with its frame.
/// \pre rest.size() >= frame_bytes
std::uint64_t chunk_bytes(Bytes rest) {
    std::uint64_t length = 0;
    for (const std::uint8_t byte : rest.first(4)) length = length << 8 | byte;
    return length + frame_bytes;
}

/// Returns the first chunk of `rest`, or all of it if it is no complete chunk.
Bytes first_chunk(Bytes rest) {
    if (rest.size() < frame_bytes || chunk_bytes(rest) > rest.size()) return rest;
    return rest.first(chunk_bytes(rest));
}

bool is_metadata(Bytes chunk) {
    if (chunk.size() < frame_bytes || chunk_bytes(chunk) != chunk.size()) return false;
    const std::string_view type = chunk_type(chunk);
    const bool is_critical = (type[0] & 0x20) == 0;
    return !is_critical && std::find(kept_chunks.begin(), kept_chunks.end(), type) == kept_chunks.end();
}

/// Calls visit(chunk) for each chunk.
template <class Visit>
void for_each_chunk(Bytes png, Visit&& visit) {
    for (Bytes rest = png.subspan(std::min(signature_bytes, png.size())); !rest.empty();) {
        const Bytes chunk = first_chunk(rest);
        visit(chunk);
        rest = rest.subspan(chunk.size());
    }
}

}  // namespace

std::vector<std::uint8_t> without_metadata(Bytes png) {
    std::size_t removed = 0;
    for_each_chunk(png, [&](Bytes chunk) {
        if (is_metadata(chunk)) removed += chunk.size();
    });
    std::vector<std::uint8_t> result;
    if (removed == 0) return result;
    result.reserve(png.size() - removed);
    result.assign(png.begin(), png.begin() + std::ptrdiff_t{signature_bytes});
    for_each_chunk(png, [&](Bytes chunk) {
        if (!is_metadata(chunk)) result.insert(result.end(), chunk.begin(), chunk.end());
    });
    return result;
}

}  // namespace faqem::detail
