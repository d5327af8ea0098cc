#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "asset/formats/formats.hpp"
#include "asset/image/srgb.hpp"
#include "asset/io/number_type.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/position_rounding.hpp"

namespace faqem::detail {
namespace {

/// Quantises a value in [0, 1] to 8 bits.
std::uint8_t quantized(double value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

/// What a vertex row has beside the arrays of the part.
struct PlyVertexLayout {
    bool doubles, alpha;
};

std::string header(const Part& part, const PlyVertexLayout& layout) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(part.positions.size());
    const auto properties = [&](const char* type, std::initializer_list<const char*> names) {
        for (const char* name : names) text += std::string("\nproperty ") + type + " " + name;
    };
    properties(layout.doubles ? "double" : "float", {"x", "y", "z"});
    if (!part.normals.empty()) properties("float", {"nx", "ny", "nz"});
    if (!part.colors.empty()) properties("uchar", {"red", "green", "blue"});
    if (layout.alpha) properties("uchar", {"alpha"});
    if (!part.uvs.empty()) properties("float", {"s", "t"});
    const bool fits_int = part.positions.size() <= std::size_t{std::numeric_limits<std::int32_t>::max()};
    return text + "\nelement face " + std::to_string(part.triangles.size()) + "\nproperty list uchar " +
           (fits_int ? "int" : "uint") + " vertex_indices\nend_header\n";
}

void put_vertex(std::vector<std::uint8_t>& bytes, const Part& part, const PlyVertexLayout& layout,
                std::size_t v) {
    for (const double x : part.positions[v]) {
        if (layout.doubles)
            put_number(bytes, x);
        else
            put_number(bytes, static_cast<float>(x));
    }
    if (!part.normals.empty())
        for (const float x : part.normals[v]) put_number(bytes, x);
    for (std::size_t k = 0; k < 3 && !part.colors.empty(); ++k)
        bytes.push_back(quantized(srgb_from_linear(part.colors[v][k])));
    if (layout.alpha) bytes.push_back(quantized(part.colors[v][3]));
    if (!part.uvs.empty()) {
        put_number(bytes, part.uvs[0][v][0]);
        put_number(bytes, 1 - part.uvs[0][v][1]);
    }
}

}  // namespace

EncodedModel encode_ply(const Asset& asset, const std::filesystem::path& file) {
    EncodedModel model;
    std::vector<std::string>& losses = model.losses;
    losses = flattening_losses(asset, "PLY");
    const Part flat = flatten_for_file(asset);
    const auto is_default = [&](Material material) {
        material.rebaked = false;
        return material == material_or_default(asset, no_index);
    };
    if (!std::ranges::all_of(asset.materials, is_default))
        losses.push_back("PLY cannot hold materials and textures");
    if (flat.uvs.size() > 1) losses.push_back("PLY cannot hold more than one set of texture coordinates");

    const PlyVertexLayout layout = {
        asset.precision.type == StoredPrecision::Type::float64 || !is_float_representable(flat.positions),
        std::ranges::any_of(flat.colors, [](const Vec4f& c) { return quantized(c[3]) != 255; })};
    const std::string text = header(flat, layout);
    std::vector<std::uint8_t> bytes(text.begin(), text.end());
    const std::size_t row = (layout.doubles ? 24 : 12) + (flat.normals.empty() ? 0 : 12) +
                            (flat.colors.empty() ? 0 : 4) + (flat.uvs.empty() ? 0 : 8);
    bytes.reserve(bytes.size() + row * flat.positions.size() + 13 * flat.triangles.size());
    for (std::size_t v = 0; v < flat.positions.size(); ++v) put_vertex(bytes, flat, layout, v);
    for (const Triangle& t : flat.triangles) {
        bytes.push_back(3);
        for (const Index v : t) put_number(bytes, std::uint32_t{v});
    }
    model.files.push_back(encoded_file(file.filename().string(), std::move(bytes)));
    return model;
}

}  // namespace faqem::detail
