#include "asset/formats/stl.hpp"

#include "asset/scene/messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "asset/io/file.hpp"
#include "asset/io/file_set.hpp"
#include "asset/io/little_endian.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/repair.hpp"
#include "asset/scene/value_numbers.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

constexpr std::size_t stl_header_bytes = 84, facet_bytes = 50;

/// Builds a part from facets and merges vertices at equal positions.
class Welder {
public:
    void add(const std::array<Vec3, 3>& corners) {
        Triangle t;
        for (int c = 0; c < 3; ++c) {
            const Vec3& p = corners[c];
            t[c] = vertices_.insert({p[0] + 0.0, p[1] + 0.0, p[2] + 0.0});  // -0 becomes 0
        }
        triangles_.push_back(t);
    }

    Part part(const std::string& file) {
        check_index_count(vertices_.values().size(), file, "vertices");
        check_index_count(triangles_.size(), file, "facets");
        Part part;
        part.positions = std::move(vertices_.values());
        part.triangles = std::move(triangles_);
        part.face_material.assign(part.triangles.size(), no_index);
        return part;
    }

private:
    UniqueValues<Vec3> vertices_;
    std::vector<Triangle> triangles_;
};

Part read_binary(std::span<const std::uint8_t> bytes, const std::string& file,
                 std::vector<std::string>& warnings) {
    const std::string_view header(reinterpret_cast<const char*>(bytes.data()), 80);
    if (header.find("COLOR=") != std::string_view::npos) warnings.push_back("facet colours are ignored");
    const std::size_t count = (bytes.size() - stl_header_bytes) / facet_bytes;
    Welder welder;
    for (std::size_t f = 0; f < count; ++f) {
        std::size_t at = stl_header_bytes + f * facet_bytes + 12;
        std::array<Vec3, 3> corners;
        for (Vec3& p : corners)
            for (double& x : p) {
                x = std::bit_cast<float>(u32_at(bytes, at));
                at += 4;
            }
        welder.add(corners);
    }
    return welder.part(file);
}

/// Reads the next word of the file, which must equal `expected`, ignoring case.
/// \throws InputError  if it does not
void expect(TextScanner& in, std::string_view expected) {
    in.skip_to_content();
    const std::string_view word = in.word();
    const bool same = std::equal(
        word.begin(), word.end(), expected.begin(), expected.end(),
        [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b; });
    if (same) return;
    if (word.empty()) in.fail("the file ends where " + TextScanner::quoted(expected) + " is expected");
    in.fail(TextScanner::quoted(word) + " instead of " + TextScanner::quoted(expected));
}

/// Whether the next word starts with the given lower-case letter, ignoring case.
bool next_starts_with(TextScanner& in, char letter) {
    in.skip_to_content();
    const std::string_view rest = in.remaining();
    return rest.starts_with(letter) || rest.starts_with(static_cast<char>(letter - 'a' + 'A'));
}

Part read_ascii(std::span<const std::uint8_t> text, const std::string& file) {
    TextScanner in(text, file, Continuation::no);
    Welder welder;
    do {
        expect(in, "solid");
        in.next_line();
        while (next_starts_with(in, 'f')) {
            expect(in, "facet");
            in.next_line();
            expect(in, "outer");
            expect(in, "loop");
            std::array<Vec3, 3> corners;
            for (Vec3& p : corners) {
                expect(in, "vertex");
                for (double& x : p) x = in.number<double>();
            }
            expect(in, "endloop");
            expect(in, "endfacet");
            welder.add(corners);
        }
        expect(in, "endsolid");
        in.next_line();
    } while (in.skip_to_content());
    return welder.part(file);
}

[[noreturn]] void fail_binary(std::span<const std::uint8_t> bytes, const std::string& file) {
    if (bytes.size() < stl_header_bytes)
        throw InputError(file, "header", "is neither ASCII STL nor long enough for binary STL");
    const std::uint64_t facets = u32_at(bytes, 80);
    throw InputError(file, "header",
                     pluralized(facets, "facet") + " need " +
                         std::to_string(stl_header_bytes + facet_bytes * facets) + " bytes, the file has " +
                         std::to_string(bytes.size()));
}

bool looks_like_text(std::span<const std::uint8_t> bytes) {
    const std::span<const std::uint8_t> start = bytes.first(std::min<std::size_t>(bytes.size(), 512));
    return std::find(start.begin(), start.end(), 0) == start.end();
}

void put_facet(std::vector<std::uint8_t>& bytes, const std::array<Vec3, 3>& p) {
    Vec3 n;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
    }
    const double length = std::hypot(n[0], n[1], n[2]);
    const bool has_normal = length > 0 && std::isfinite(length);
    for (const double x : n)
        put_u32(bytes, std::bit_cast<std::uint32_t>(has_normal ? static_cast<float>(x / length) : 0.0f));
    for (const Vec3& corner : p)
        for (const double x : corner) put_u32(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    bytes.insert(bytes.end(), 2, 0);
}

}  // namespace

Asset read_stl(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    Asset asset;
    const bool is_binary = bytes.size() >= stl_header_bytes &&
                           bytes.size() == stl_header_bytes + facet_bytes * std::uint64_t{u32_at(bytes, 80)};
    if (!is_binary && !looks_like_text(bytes)) fail_binary(bytes, file.string());
    asset.parts.push_back(is_binary ? read_binary(bytes, file.string(), asset.warnings)
                                    : read_ascii(bytes, file.string()));
    Part& part = asset.parts[0];
    part.name = file.stem().string();
    repair_non_finite(part, file.string(), 0, asset.warnings);
    return asset;
}

Asset read_stl(const std::filesystem::path& file) { return read_stl(read_file(file), file); }

std::vector<std::string> write_stl(const Asset& asset, const std::filesystem::path& file,
                                   Overwrite overwrite) {
    std::vector<std::string> losses = flattening_losses(asset, "STL");
    const Part flat = flatten(asset);
    for (const Vec3& p : flat.positions)
        for (const double x : p)
            if (!(std::abs(x) <= std::numeric_limits<float>::max()))
                throw WriteError(file.string() + ": STL cannot hold coordinates beyond 3.4e38");
    if (!is_float_representable(flat.positions))
        losses.push_back("STL cannot hold positions in double precision");
    if (!flat.normals.empty()) losses.push_back("STL cannot hold vertex normals");
    if (!flat.uvs.empty()) losses.push_back("STL cannot hold texture coordinates");
    if (!flat.colors.empty()) losses.push_back("STL cannot hold colours");
    if (!asset.materials.empty()) losses.push_back("STL cannot hold materials");

    std::vector<std::uint8_t> bytes(80, ' ');
    bytes.reserve(stl_header_bytes + facet_bytes * flat.triangles.size());
    put_u32(bytes, static_cast<std::uint32_t>(flat.triangles.size()));
    for (const Triangle& t : flat.triangles)
        put_facet(bytes, {flat.positions[t[0]], flat.positions[t[1]], flat.positions[t[2]]});
    write_file(file, bytes, overwrite);
    return losses;
}

}  // namespace faqem::detail
