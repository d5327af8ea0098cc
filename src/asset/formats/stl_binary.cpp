#include "asset/formats/stl_binary.hpp"

#include <bit>
#include <string_view>

#include "asset/image/srgb.hpp"
#include "asset/io/little_endian.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/repair.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

constexpr std::size_t label_bytes = 80;  // of the header, before the count

std::uint32_t attribute(const BinaryStl& stl, std::size_t facet) {
    const std::size_t at = stl_header_bytes + facet * facet_bytes + facet_bytes - 2;
    return stl.bytes[at] | std::uint32_t{stl.bytes[at + 1]} << 8;
}

constexpr std::uint32_t highest_bit = 0x8000;

float linear(double display) { return static_cast<float>(linear_from_srgb(display)); }

/// The colour in the 15 lower bits, with red in the lowest ones or, reversed, in the highest ones.
Vec4f color_of(std::uint32_t bits, bool is_reversed) {
    const auto channel = [&](unsigned k) { return linear((bits >> (5 * k) & 31) / 31.0); };
    const Vec4f color = {channel(0), channel(1), channel(2), 1};
    return is_reversed ? Vec4f{color[2], color[1], color[0], 1} : color;
}

void read_colors(BinaryStl& stl, std::vector<std::string>& warnings) {
    constexpr std::string_view keyword = "COLOR=";
    const std::string_view label(reinterpret_cast<const char*>(stl.bytes.data()), label_bytes);
    const std::size_t at = label.find(keyword);
    const std::size_t first = at + keyword.size();
    const bool is_magics = at != std::string_view::npos && first + 4 <= label.size();
    std::size_t marked = 0, used = 0;
    for (std::size_t f = 0; f < stl.facets; ++f) {
        marked += (attribute(stl, f) & highest_bit) != 0;
        used += attribute(stl, f) != 0;
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
        const bool is_marked = (attribute(stl, f) & highest_bit) != 0;
        stl.colors.push_back(is_marked != is_magics ? color_of(attribute(stl, f), !is_magics) : other);
    }
}

}  // namespace

std::array<Vec3, 3> BinaryStl::corners(std::size_t facet) const {
    std::size_t at = stl_header_bytes + facet * facet_bytes + 12;
    std::array<Vec3, 3> result;
    for (Vec3& p : result)
        for (double& x : p) {
            x = std::bit_cast<float>(u32_at(bytes, at));
            at += 4;
        }
    return result;
}

BinaryStl read_binary_stl(std::span<const std::uint8_t> bytes, const std::string& file,
                          std::vector<std::string>& warnings) {
    if (bytes.size() < stl_header_bytes)
        throw InputError(file, "header", "is neither ASCII STL nor long enough for binary STL");
    const std::uint64_t stated = u32_at(bytes, label_bytes);
    const std::uint64_t room = (bytes.size() - stl_header_bytes) / facet_bytes;
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
    const std::uint64_t rest = bytes.size() - stl_header_bytes - facet_bytes * stl.facets;
    if (rest) warnings.push_back(pluralized(rest, "byte") + " after the last facet ignored");
    read_colors(stl, warnings);
    return stl;
}

}  // namespace faqem::detail
