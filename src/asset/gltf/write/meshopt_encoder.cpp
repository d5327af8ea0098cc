#include "asset/gltf/write/meshopt_encoder.hpp"

#ifdef FAQEM_WITH_MESHOPT
#include <meshoptimizer.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstring>

namespace faqem::detail {

#ifdef FAQEM_WITH_MESHOPT

namespace {

// EXT_meshopt_compression has these versions of the codecs.
constexpr int vertex_codec_version = 0, index_codec_version = 1;

// Rounded unit vectors have a length that differs from 1 by less than 5e-4, so that they are kept when written again.
constexpr int direction_exponent = -11, texture_coordinate_exponent = -15;

// Mantissas have 24 bits with their sign.
constexpr float max_mantissa = (1 << 23) - 1;

// The versions are global in meshoptimizer: they are set once, since files may be written by several threads.
void set_codec_versions() {
    [[maybe_unused]] static const bool is_set = [] {
        meshopt_encodeVertexVersion(vertex_codec_version);
        meshopt_encodeIndexVersion(index_codec_version);
        return true;
    }();
}

// Floats as multiples of 2^exponent, in the layout of the filter EXPONENTIAL; nothing if one is out of range.
std::optional<std::vector<std::uint8_t>> rounded_floats(std::span<const std::uint8_t> bytes, int exponent) {
    std::vector<std::uint8_t> result(bytes.size());
    for (std::size_t i = 0; i + sizeof(float) <= bytes.size(); i += sizeof(float)) {
        const float mantissa = std::round(std::ldexp(load_number<float>(&bytes[i]), -exponent));
        if (!(std::abs(mantissa) <= max_mantissa)) return std::nullopt;
        const auto integer = static_cast<std::uint32_t>(static_cast<std::int32_t>(mantissa));
        const std::uint32_t packed = static_cast<std::uint32_t>(exponent) << 24 | (integer & 0xffffff);
        std::memcpy(&result[i], &packed, sizeof(packed));
    }
    return result;
}

// Unit vectors of normalised 16-bit integers in the layout of the filter OCTAHEDRAL.
std::vector<std::uint8_t> octahedral(std::span<const std::uint8_t> bytes, std::uint32_t bits) {
    constexpr float unit = 32767;
    std::vector<float> values(bytes.size() / sizeof(std::int16_t));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(load_number<std::int16_t>(&bytes[2 * i])) / unit;
    std::vector<std::uint8_t> result(bytes.size());
    meshopt_encodeFilterOct(result.data(), values.size() / 4, 8, static_cast<int>(bits), values.data());
    return result;
}

CompressedView encoded_attributes(std::span<const std::uint8_t> bytes, std::uint64_t stride,
                                  std::string_view filter) {
    CompressedView view{{}, bytes.size() / stride, "ATTRIBUTES", filter};
    view.bytes.resize(meshopt_encodeVertexBufferBound(view.count, stride));
    view.bytes.resize(
        meshopt_encodeVertexBuffer(view.bytes.data(), view.bytes.size(), bytes.data(), view.count, stride));
    return view;
}

CompressedView encoded_triangles(std::span<const std::uint8_t> bytes, std::uint64_t stride) {
    CompressedView view{{}, bytes.size() / stride, "TRIANGLES", {}};
    std::vector<unsigned> indices(view.count);
    for (std::size_t i = 0; i < indices.size(); ++i) std::memcpy(&indices[i], &bytes[i * stride], stride);
    const unsigned vertices = 1 + *std::ranges::max_element(indices);
    view.bytes.resize(meshopt_encodeIndexBufferBound(view.count, vertices));
    view.bytes.resize(
        meshopt_encodeIndexBuffer(view.bytes.data(), view.bytes.size(), indices.data(), indices.size()));
    return view;
}

}  // namespace

std::optional<CompressedView> encode_meshopt(std::span<const std::uint8_t> bytes, std::uint64_t stride,
                                             AccessorUse use, const VertexBits& bits) {
    constexpr std::uint64_t max_stride = 256;
    if (bytes.empty()) return std::nullopt;
    set_codec_versions();
    std::optional<CompressedView> view;
    if (use == AccessorUse::triangles && bytes.size() / stride % 3 == 0)
        view = encoded_triangles(bytes, stride);
    else if (use == AccessorUse::short_directions && stride == 8 && bits.normals > 0)
        view = encoded_attributes(octahedral(bytes, bits.normals), stride, "OCTAHEDRAL");
    else if (is_vertex_attribute(use) && stride <= max_stride) {
        std::optional<std::vector<std::uint8_t>> rounded;
        if (use == AccessorUse::directions) rounded = rounded_floats(bytes, direction_exponent);
        if (use == AccessorUse::texture_coordinates)
            rounded = rounded_floats(
                bytes, bits.uvs > 0 ? -static_cast<int>(bits.uvs) : texture_coordinate_exponent);
        view = rounded ? encoded_attributes(*rounded, stride, "EXPONENTIAL")
                       : encoded_attributes(bytes, stride, {});
    }
    if (view && view->bytes.size() >= bytes.size()) view.reset();
    return view;
}

#else

std::optional<CompressedView> encode_meshopt(std::span<const std::uint8_t>, std::uint64_t, AccessorUse,
                                             const VertexBits&) {
    return std::nullopt;
}

#endif

}  // namespace faqem::detail
