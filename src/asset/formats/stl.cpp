#include "asset/formats/formats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "asset/image/srgb.hpp"
#include "asset/io/number_type.hpp"
#include "asset/scene/affine.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/position_rounding.hpp"
#include "asset/scene/repair.hpp"
#include "asset/scene/value_numbers.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/detail/base/lower_case.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// Builds a part from facets and merges vertices at equal positions and with equal colours.
class Welder {
public:
    /// \param color  linear; equal for all facets if the file has no colours
    void add(const std::array<Vec3, 3>& corners, const Vec4f& color = {1, 1, 1, 1}) {
        const double number = colors_.insert(color);
        Triangle t;
        for (int c = 0; c < 3; ++c) {
            const Vec3& p = corners[c];
            t[c] = vertices_.insert({p[0] + 0.0, p[1] + 0.0, p[2] + 0.0, number});  // -0 becomes 0
        }
        triangles_.push_back(t);
    }

    Part part(const std::string& file) {
        const std::vector<std::array<double, 4>>& vertices = vertices_.values();
        check_index_count(vertices.size(), file, "vertices");
        check_index_count(triangles_.size(), file, "facets");
        Part part;
        part.positions.reserve(vertices.size());
        for (const auto& v : vertices) part.positions.push_back({v[0], v[1], v[2]});
        const std::vector<Vec4f>& colors = colors_.values();
        if (std::ranges::any_of(colors, [](const Vec4f& c) { return c != Vec4f{1, 1, 1, 1}; }))
            for (const auto& v : vertices) part.colors.push_back(colors[static_cast<std::size_t>(v[3])]);
        part.triangles = std::move(triangles_);
        part.face_material.assign(part.triangles.size(), no_index);
        return part;
    }

private:
    UniqueValues<std::array<double, 4>> vertices_;  // position and number of the colour
    UniqueValues<Vec4f> colors_;
    std::vector<Triangle> triangles_;
};

/// Reads the next word of the file, which must equal `expected`, ignoring case.
/// \throws InputError  if it does not
void expect(TextScanner& in, std::string_view expected) {
    in.skip_to_content();
    const std::string_view word = in.word();
    if (lower_case(std::string(word)) == expected) return;
    if (word.empty()) in.fail("the file ends where " + TextScanner::quoted(expected) + " is expected");
    in.fail(TextScanner::quoted(word) + " instead of " + TextScanner::quoted(expected));
}

/// Whether the next word starts with the given lower-case letter, ignoring case.
bool next_starts_with(TextScanner& in, char letter) {
    in.skip_to_content();
    const std::string_view rest = in.remaining();
    return rest.starts_with(letter) || rest.starts_with(static_cast<char>(letter - 'a' + 'A'));
}

/// Whether the text after the last solid is no solid, but junk that has no facets.
bool is_junk(TextScanner in) {
    const std::string_view rest = in.remaining();
    return lower_case(std::string(in.word())) != "solid" && rest.find("facet") == std::string_view::npos &&
           rest.find("FACET") == std::string_view::npos;
}

Part read_ascii(std::span<const std::uint8_t> text, const std::string& file, StoredPrecision& precision,
                std::vector<std::string>& warnings) {
    TextScanner in(text, file, Continuation::no);
    Welder welder;
    std::vector<std::string> names;
    std::vector<Index> solids;  // by facet
    do {
        expect(in, "solid");
        names.push_back(in.rest_of_line());
        in.next_line();
        while (next_starts_with(in, 'f')) {
            expect(in, "facet");
            in.next_line();
            expect(in, "outer");
            expect(in, "loop");
            std::array<Vec3, 3> corners;
            for (Vec3& p : corners) {
                expect(in, "vertex");
                for (double& x : p) x = read_coordinate(in, precision);
            }
            expect(in, "endloop");
            expect(in, "endfacet");
            welder.add(corners);
            solids.push_back(static_cast<Index>(names.size() - 1));
        }
        expect(in, "endsolid");
        in.next_line();
        if (!in.skip_to_content()) break;
        if (!solids.empty() && is_junk(in)) {
            warnings.push_back(pluralized(in.remaining().size(), "byte") + " after the last solid ignored");
            break;
        }
    } while (true);
    Part part = welder.part(file);
    for (std::string& name : names)
        if (name.empty()) name = std::filesystem::path(file).stem().string();
    set_objects(part, solids, names);
    return part;
}

bool looks_like_text(std::span<const std::uint8_t> bytes) {
    const std::span<const std::uint8_t> start = bytes.first(std::min<std::size_t>(bytes.size(), 512));
    return std::ranges::find(start, 0) == start.end();
}

constexpr std::size_t label_bytes = 80;  // of the header of a binary file, before the count
constexpr std::size_t header_bytes = 84, facet_bytes = 50;

/// The content of a binary STL file.
struct BinaryStl {
    std::span<const std::uint8_t> bytes;  ///< the file, borrowed
    std::size_t facets = 0;
    std::vector<Vec4f> colors;  ///< by facet, linear; empty: the file has none

    std::array<Vec3, 3> corners(std::size_t facet) const {
        std::size_t at = header_bytes + facet * facet_bytes + 12;
        std::array<Vec3, 3> result;
        for (Vec3& p : result)
            for (double& x : p) {
                x = load_number<float>(&bytes[at]);
                at += sizeof(float);
            }
        return result;
    }

    std::uint32_t attribute(std::size_t facet) const {
        const std::size_t at = header_bytes + facet * facet_bytes + facet_bytes - 2;
        return load_number<std::uint16_t>(&bytes[at]);
    }
};

constexpr std::uint32_t highest_bit = 0x8000;

float linear(double display) { return static_cast<float>(linear_from_srgb(display)); }

/// The colour in the 15 lower bits, with red in the lowest ones or, reversed, in the highest ones.
Vec4f color_of(std::uint32_t bits, bool is_reversed) {
    const auto channel = [&](unsigned k) { return linear((bits >> (5 * k) & 31) / 31.0); };
    const Vec4f color = {channel(0), channel(1), channel(2), 1};
    return is_reversed ? Vec4f{color[2], color[1], color[0], 1} : color;
}

/// Reads the attributes of facets as colours, 5 bits each for red, green and blue, which are sRGB. Magics: if the header
/// contains `COLOR=`, followed by RGBA as bytes, red has the lowest bits, and facets with the highest bit set have the
/// colour of the header. VisCAM and SolidView: otherwise, if a facet has the highest bit set; these have a colour, with
/// blue in the lowest bits, and the others are white.
void read_colors(BinaryStl& stl, std::vector<std::string>& warnings) {
    constexpr std::string_view keyword = "COLOR=";
    const std::string_view label(reinterpret_cast<const char*>(stl.bytes.data()), label_bytes);
    const std::size_t at = label.find(keyword);
    const std::size_t first = at + keyword.size();
    const bool is_magics = at != std::string_view::npos && first + 4 <= label.size();
    std::size_t marked = 0, used = 0;
    for (std::size_t f = 0; f < stl.facets; ++f) {
        marked += (stl.attribute(f) & highest_bit) != 0;
        used += stl.attribute(f) != 0;
    }
    if (!is_magics && marked == 0) {
        if (used)
            warnings.push_back("attributes of " + pluralized(used, "facet") +
                               " ignored: they are no colours");
        return;
    }
    Vec4f other = {1, 1, 1, 1};
    for (std::size_t k = 0; k < 4 && is_magics; ++k) {
        const double value = stl.bytes[first + k] / 255.0;
        other[k] = k < 3 ? linear(value) : static_cast<float>(value);
    }
    stl.colors.reserve(stl.facets);
    for (std::size_t f = 0; f < stl.facets; ++f) {
        const bool is_marked = (stl.attribute(f) & highest_bit) != 0;
        stl.colors.push_back(is_marked != is_magics ? color_of(stl.attribute(f), !is_magics) : other);
    }
}

/// Reads as many facets as the header says. If these are none, or more than there is room for, all whole facets of the file
/// are read, unless a coordinate is not finite, so that the file is hardly STL.
BinaryStl read_binary_stl(std::span<const std::uint8_t> bytes, const std::string& file,
                          std::vector<std::string>& warnings) {
    if (bytes.size() < header_bytes)
        throw InputError(file, "header", "is neither ASCII STL nor long enough for binary STL");
    const std::uint64_t stated = u32_at(bytes, label_bytes);
    const std::uint64_t room = (bytes.size() - header_bytes) / facet_bytes;
    const bool is_count_right = stated <= room && (stated > 0 || room == 0);
    BinaryStl stl{bytes, static_cast<std::size_t>(is_count_right ? stated : room), {}};
    if (!is_count_right) {
        const std::string difference = "the header states " + pluralized(stated, "facet") +
                                       ", the file has room for " + std::to_string(room);
        if (room == 0) throw InputError(file, "header", difference);
        for (std::size_t f = 0; f < stl.facets; ++f)
            for (const Vec3& p : stl.corners(f))
                if (!is_finite(p))
                    throw InputError(file, "header",
                                     difference + ", and facet " + std::to_string(f) +
                                         " is not finite: is this an STL file?");
        warnings.push_back(difference + ", which are read");
    }
    add_counted(warnings, bytes.size() - header_bytes - facet_bytes * stl.facets, "byte",
                " after the last facet ignored");
    read_colors(stl, warnings);
    return stl;
}

void put_facet(std::vector<std::uint8_t>& bytes, const std::array<Vec3, 3>& p) {
    const Vec3 n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    const double length = std::hypot(n[0], n[1], n[2]);
    const bool has_normal = length > 0 && std::isfinite(length);
    for (const double x : n) put_number(bytes, has_normal ? static_cast<float>(x / length) : 0.0f);
    for (const Vec3& corner : p)
        for (const double x : corner) put_number(bytes, static_cast<float>(x));
    bytes.insert(bytes.end(), 2, 0);
}

}  // namespace

Asset read_stl(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    Asset asset;
    const bool has_binary_size =
        bytes.size() >= header_bytes &&
        bytes.size() == header_bytes + facet_bytes * std::uint64_t{u32_at(bytes, label_bytes)};
    Part part;
    if (has_binary_size || !looks_like_text(bytes)) {
        asset.precision.type = StoredPrecision::Type::float32;
        const BinaryStl content = read_binary_stl(bytes, file.string(), asset.warnings);
        Welder welder;
        for (std::size_t f = 0; f < content.facets; ++f)
            welder.add(content.corners(f), content.colors.empty() ? Vec4f{1, 1, 1, 1} : content.colors[f]);
        part = welder.part(file.string());
    } else {
        part = read_ascii(bytes, file.string(), asset.precision, asset.warnings);
    }
    part.name = file.stem().string();
    repair_non_finite(part, file.string(), 0, asset.warnings);
    asset.parts.push_back(std::move(part));
    return asset;
}

EncodedModel encode_stl(const Asset& asset, const std::filesystem::path& file) {
    EncodedModel model;
    std::vector<std::string>& losses = model.losses;
    losses = flattening_losses(asset, "STL");
    const Part flat = flatten(asset);
    for (const Vec3& p : flat.positions)
        for (const double x : p)
            if (!(std::abs(x) <= std::numeric_limits<float>::max()))
                throw WriteError(file.string() + ": STL cannot hold coordinates beyond 3.4e38");
    if (loses_digits_as_floats(asset.precision, flat.positions))
        losses.push_back("STL cannot hold positions in double precision");
    if (!flat.normals.empty()) losses.push_back("STL cannot hold vertex normals");
    if (!flat.uvs.empty()) losses.push_back("STL cannot hold texture coordinates");
    if (!flat.colors.empty()) losses.push_back("STL cannot hold colours");
    if (!asset.materials.empty()) losses.push_back("STL cannot hold materials");

    std::vector<std::uint8_t> bytes(label_bytes, ' ');
    bytes.reserve(header_bytes + facet_bytes * flat.triangles.size());
    put_number(bytes, static_cast<std::uint32_t>(flat.triangles.size()));
    for (const Triangle& t : flat.triangles)
        put_facet(bytes, {flat.positions[t[0]], flat.positions[t[1]], flat.positions[t[2]]});
    model.files.push_back(encoded_file(file.filename().string(), std::move(bytes)));
    return model;
}

}  // namespace faqem::detail
