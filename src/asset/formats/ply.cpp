#include "asset/formats/formats.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include "asset/formats/ply_file.hpp"
#include "asset/formats/polygon_content.hpp"
#include "asset/image/srgb.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/repair.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

// Meaning of a vertex property. Properties with other names are `skipped`.
enum VertexProperty { x, y, z, nx, ny, nz, red, green, blue, alpha, s, t, skipped };

/// A value for each property.
using PlyRow = std::array<double, skipped + 1>;

VertexProperty vertex_property(const PlyProperty& property) {
    static constexpr std::array<std::array<std::string_view, 12>, 3> names = {
        {{"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha", "s", "t"},
         {"", "", "", "", "", "", "r", "g", "b", "a", "u", "v"},
         {"", "", "", "", "", "", "diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha",
          "texture_u", "texture_v"}}};
    for (const auto& row : names) {
        const auto found = std::ranges::find(row, property.name);
        if (found != row.end() && !property.is_list) return static_cast<VertexProperty>(found - row.begin());
    }
    return skipped;
}

/// The properties of an element that have a meaning, and their values in a row.
struct PlySlots {
    std::vector<VertexProperty> of;  // by property
    PlyRow scale = {};               // of colours to [0, 1]; 0: no such property
    PlyRow row = {};

    explicit PlySlots(const PlyElement& element) {
        for (const PlyProperty& p : element.properties) {
            of.push_back(vertex_property(p));
            scale[of.back()] = visit_type(p.type, [](auto number) {
                return std::is_integral_v<decltype(number)>
                           ? 1.0 / std::numeric_limits<decltype(number)>::max()
                           : 1;
            });
        }
    }

    bool has(std::initializer_list<VertexProperty> all) const {
        return std::ranges::all_of(all, [&](VertexProperty slot) { return scale[slot] > 0; });
    }

    /// Reads a property, unless it has no meaning.
    template <class Data>
    bool take(std::size_t i, const PlyElement& element, Data& data) {
        if (of[i] == skipped) return false;
        row[of[i]] = data.value(element.properties[i].type);
        return true;
    }
};

/// Reads the elements of a PLY file.
/// \tparam Data  PlyAsciiData or PlyBinaryData
template <class Data>
class PlyReader {
public:
    PlyReader(const PlyHeader& header, Data data, const std::string& file, std::vector<std::string>& warnings)
        : header_(header), data_(std::move(data)), file_(file), warnings_(warnings) {}

    PolygonContent run() {
        check_elements();
        for (const PlyElement& element : header_.elements) {
            if (element.count == 0) continue;
            check_row_count(element);
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(element);
            else if (element.name == "tristrips")
                read_strips(element);
            else
                read_other(element);
        }
        add_counted(warnings_, data_.remaining_bytes(), "byte", " after the last element ignored");
        divide_byte_colors(largest_float_color_, {&part_.colors, &faces_.colors}, warnings_);
        return std::move(content_);
    }

private:
    void check_elements() {
        for (const char* name : {"vertex", "face", "tristrips"})
            if (std::ranges::count_if(header_.elements, [&](const auto& e) { return e.name == name; }) > 1)
                throw InputError(file_, "header", std::string("more than one element ") + name);
        for (const PlyElement& element : header_.elements)
            check_index_count(element.count, file_, element.name);
        const auto vertex = std::ranges::find(header_.elements, "vertex", &PlyElement::name);
        if (vertex == header_.elements.end()) throw InputError(file_, "header", "no element vertex");
        vertex_count_ = vertex->count;
    }

    void check_row_count(const PlyElement& element) {
        std::uint64_t bytes = 0;
        for (const PlyProperty& p : element.properties)
            bytes += number_size(p.is_list ? p.count_type : p.type);
        if (bytes && element.count > data_.max_row_count(element.properties.size(), bytes))
            throw InputError(file_, "element " + element.name,
                             "the file is too short for " + pluralized(element.count, "row"));
    }

    /// Calls take(p) for each property of each row of an element, which reads it or returns false if it is to be skipped,
    /// and row() at its end. Adds the name and index of the row to error messages.
    template <class Take, class Row>
    void for_each_row(const PlyElement& element, Take&& take, Row&& row) {
        if (element.properties.empty()) return;
        std::uint64_t i = 0;
        try {
            for (; i < element.count; ++i) {
                data_.begin_row();
                for (std::size_t p = 0; p < element.properties.size(); ++p)
                    if (!take(p)) skip(element.properties[p]);
                row();
                data_.end_row();
            }
        } catch (const InputError& error) {
            throw InputError(std::string(error.what()) + " (" + element.name + " " + std::to_string(i) + ")");
        }
    }

    std::uint64_t list_size(const PlyProperty& property) {
        const double size = data_.value(property.count_type);
        if (size < 0) data_.fail("a list has a negative length");
        const auto count = static_cast<std::uint64_t>(size);
        if (count && count > data_.max_row_count(1, number_size(property.type)))
            data_.fail("the file is too short for a list of " + std::to_string(count));
        return count;
    }

    void skip(const PlyProperty& property) {
        for (std::uint64_t n = property.is_list ? list_size(property) : 1; n > 0; --n)
            data_.value(property.type);
    }

    void add_not_understood(const PlyElement& element, const PlyProperty& property) {
        content_.not_understood.push_back("property '" + property.name + "' of " + element.name);
    }

    void read_other(const PlyElement& element) {
        content_.not_understood.push_back("element '" + element.name + "'");
        for_each_row(
            element, [](std::size_t) { return false; }, [] {});
    }

    void read_vertices(const PlyElement& element) {
        PlySlots slots(element);
        if (!slots.has({x, y, z}))
            throw InputError(file_, "element vertex", "must have the properties x, y and z");
        part_.positions.resize(element.count);
        if (slots.has({nx, ny, nz})) part_.normals.resize(element.count);
        if (slots.has({red, green, blue})) part_.colors.resize(element.count);
        if (slots.has({s, t})) part_.uvs.emplace_back(element.count);
        for (std::size_t i = 0; i < slots.of.size(); ++i) {
            const VertexProperty slot = slots.of[i];
            const bool is_used = slot <= z       ? true
                                 : slot <= nz    ? !part_.normals.empty()
                                 : slot <= alpha ? !part_.colors.empty()
                                                 : slot <= t && !part_.uvs.empty();
            if (!is_used) add_not_understood(element, element.properties[i]);
        }
        std::size_t vertex = 0;
        for_each_row(
            element, [&](std::size_t i) { return slots.take(i, element, data_); },
            [&] { store_vertex(vertex++, slots.row, slots.scale); });
    }

    void store_vertex(std::size_t v, const PlyRow& row, const PlyRow& scale) {
        part_.positions[v] = {row[x], row[y], row[z]};
        const auto number = [&](VertexProperty slot) { return static_cast<float>(row[slot]); };
        if (!part_.normals.empty()) part_.normals[v] = {number(nx), number(ny), number(nz)};
        if (!part_.uvs.empty()) part_.uvs[0][v] = {number(s), 1 - number(t)};
        if (!part_.colors.empty()) part_.colors[v] = color(row, scale);
    }

    Vec4f color(const PlyRow& row, const PlyRow& scale) {
        const double opacity = scale[alpha] > 0 ? row[alpha] * scale[alpha] : 1;
        Vec4f result = {0, 0, 0, static_cast<float>(opacity)};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t slot = red + k;
            result[k] = static_cast<float>(linear_from_srgb(row[slot] * scale[slot]));
            const bool is_float = scale[slot] == 1;
            if (is_float && row[slot] <= 255)
                largest_float_color_ = std::max(largest_float_color_, row[slot]);
        }
        return result;
    }

    /// The property with the vertices of faces or strips.
    std::size_t index_list(const PlyElement& element) const {
        const auto indices = std::ranges::find_if(element.properties, [](const PlyProperty& p) {
            return p.name == "vertex_indices" || p.name == "vertex_index";
        });
        if (indices == element.properties.end() || !indices->is_list || !is_integer(indices->type))
            throw InputError(file_, "element " + element.name,
                             "must have an integer list property vertex_indices");
        return static_cast<std::size_t>(indices - element.properties.begin());
    }

    void read_list(const PlyProperty& property, std::vector<double>& list) {
        list.resize(list_size(property));
        for (double& value : list) value = data_.value(property.type);
    }

    void read_strips(const PlyElement& element) {
        const std::size_t indices = index_list(element);
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& p = element.properties[i];
            if (p.name == "texcoord" || p.name == "red")
                warnings_.push_back("'" + p.name + "' of " + element.name + " is ignored");
            else if (i != indices)
                add_not_understood(element, p);
        }
        std::vector<double> list;
        const auto take = [&](std::size_t i) {
            if (i == indices) read_list(element.properties[i], list);
            return i == indices;
        };
        for_each_row(element, take, [&] { add_strip(list); });
    }

    void read_faces(const PlyElement& element) {
        const std::size_t indices = index_list(element);
        const std::vector<PlyProperty>& properties = element.properties;
        const auto find = [&](std::string_view name, bool is_list) {
            const auto found = std::ranges::find_if(
                properties, [&](const PlyProperty& p) { return p.name == name && p.is_list == is_list; });
            return static_cast<std::size_t>(found - properties.begin());
        };
        const std::size_t uvs = find("texcoord", true), texture = find("texnumber", false);
        PlySlots slots(element);
        for (VertexProperty& slot : slots.of)
            if (slot < red || slot > alpha) slot = skipped;
        const bool has_colors = slots.has({red, green, blue});
        for (std::size_t i = 0; i < properties.size(); ++i)
            if (i != indices && i != uvs && i != texture && (slots.of[i] == skipped || !has_colors))
                add_not_understood(element, properties[i]);
        std::vector<double> list, coordinates;
        double number = 0;
        const auto take = [&](std::size_t i) {
            if (i == indices || i == uvs)
                read_list(properties[i], i == indices ? list : coordinates);
            else if (i == texture)
                number = data_.value(properties[i].type);
            else
                return slots.take(i, element, data_);
            return true;
        };
        for_each_row(element, take, [&] {
            add_face(list);
            if (uvs < properties.size()) add_coordinates(coordinates, list.size());
            if (texture < properties.size()) faces_.textures.push_back(number);
            if (has_colors) faces_.colors.push_back(color(slots.row, slots.scale));
        });
    }

    Index vertex(double index) const {
        if (!(index >= 0 && index < static_cast<double>(vertex_count_)))
            data_.fail("vertex " + std::to_string(static_cast<std::int64_t>(index)) +
                       " is out of range: there are " + std::to_string(vertex_count_));
        return static_cast<Index>(index);
    }

    void add_face(const std::vector<double>& list) {
        for (const double i : list) faces_.polygons.vertices.push_back(vertex(i));
        faces_.polygons.sizes.push_back(static_cast<std::uint32_t>(list.size()));
    }

    /// Adds two texture coordinates for each corner of a face, or none for a face without a texture.
    void add_coordinates(const std::vector<double>& list, std::size_t corners) {
        if (!list.empty() && list.size() != 2 * corners)
            data_.fail("'texcoord' has " + std::to_string(list.size()) + " values instead of " +
                       std::to_string(2 * corners));
        faces_.has_uvs.push_back(!list.empty());
        for (std::size_t c = 0; c < corners; ++c)
            faces_.uvs.push_back(list.empty() ? Vec2f{0, 0}
                                              : Vec2f{static_cast<float>(list[2 * c]),
                                                      1 - static_cast<float>(list[2 * c + 1])});
    }

    /// Adds the triangles of strips that are separated by -1. The winding of every second triangle is
    /// reversed. Degenerate triangles, which only connect strips, are left out.
    void add_strip(const std::vector<double>& list) {
        std::size_t first = 0;
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i] == -1) {
                first = i + 1;
                continue;
            }
            const Index c = vertex(list[i]);
            if (i < first + 2) continue;
            const Index a = vertex(list[i - 2]), b = vertex(list[i - 1]);
            if (a == b || b == c || c == a) continue;
            const bool is_reversed = (i - first) % 2 == 1;
            strips_.vertices.insert(strips_.vertices.end(), {is_reversed ? b : a, is_reversed ? a : b, c});
            strips_.sizes.push_back(3);
        }
    }

    const PlyHeader& header_;
    Data data_;
    const std::string file_;
    std::vector<std::string>& warnings_;
    PolygonContent content_;
    Part& part_ = content_.part;
    PolygonFaces& faces_ = content_.faces;
    Polygons& strips_ = content_.strips;
    std::uint64_t vertex_count_ = 0;
    double largest_float_color_ = 0;
};

/// The type of the positions; that of integers is unknown.
StoredPrecision position_precision(const PlyHeader& header) {
    const auto has_type = [&](NumberType type) {
        const auto is_coordinate = [&](const PlyProperty& p) {
            return p.type == type && !p.is_list && vertex_property(p) <= z;
        };
        return std::ranges::any_of(header.elements, [&](const PlyElement& e) {
            return e.name == "vertex" && std::ranges::any_of(e.properties, is_coordinate);
        });
    };
    if (has_type(NumberType::f64)) return {StoredPrecision::Type::float64};
    return {has_type(NumberType::f32) ? StoredPrecision::Type::float32 : StoredPrecision::Type::unknown};
}

}  // namespace

Asset read_ply(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    std::vector<std::string> warnings;
    const PlyHeader header = read_ply_header(bytes, file.string());
    const std::span<const std::uint8_t> data = bytes.subspan(header.size);
    PolygonContent content =
        header.format == PlyFormat::ascii
            ? PlyReader(header, PlyAsciiData(data, file.string(), header.lines), file.string(), warnings)
                  .run()
            : PlyReader(header, PlyBinaryData(data, file.string(), header.format), file.string(), warnings)
                  .run();
    Asset asset = polygon_asset(std::move(content), header.texture_files, file, std::move(warnings));
    asset.precision = position_precision(header);
    return asset;
}

}  // namespace faqem::detail
