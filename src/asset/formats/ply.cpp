#include "asset/formats/ply.hpp"

#include "asset/scene/messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "asset/formats/ply_header.hpp"
#include "asset/formats/triangulate.hpp"
#include "asset/image/srgb.hpp"
#include "asset/io/file.hpp"
#include "asset/scene/repair.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

struct TypeRange {
    double low, high;
};

TypeRange range_of(PlyType type) {
    static constexpr std::array<TypeRange, 6> ranges = {{{-128, 127},
                                                         {0, 255},
                                                         {-32768, 32767},
                                                         {0, 65535},
                                                         {-2147483648.0, 2147483647.0},
                                                         {0, 4294967295.0}}};
    return ranges[static_cast<std::size_t>(type)];
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

/// Reads the values of an ASCII file, where each row is a line.
class AsciiData {
public:
    AsciiData(std::span<const std::uint8_t> data, const std::string& file, std::uint64_t lines)
        : in_(data, file, Continuation::no, lines) {}

    /// Maximum number of rows of `values` values that the remaining bytes can hold.
    std::uint64_t max_row_count(std::uint64_t values, std::uint64_t) const {
        return (in_.remaining().size() + 1) / 2 / values;
    }
    void begin_row() { in_.skip_to_content(); }
    void end_row() { in_.finish_line(); }
    std::uint64_t remaining_bytes() {
        in_.skip_to_content();
        return in_.remaining().size();
    }
    [[noreturn]] void fail(const std::string& what) const { in_.fail(what); }

    double value(PlyType type) {
        if (type == PlyType::float64) return in_.number<double>();
        if (type == PlyType::float32) return in_.number<float>();
        const auto value = static_cast<double>(in_.number<std::int64_t>());
        const TypeRange range = range_of(type);
        if (value < range.low || value > range.high)
            in_.fail("a value does not fit the type of its property");
        return value;
    }

private:
    TextScanner in_;
};

/// Reads the values of a binary file. Same interface as AsciiData.
class BinaryData {
public:
    BinaryData(std::span<const std::uint8_t> data, const std::string& file, PlyFormat format)
        : at_(data.data()),
          end_(at_ + data.size()),
          file_(file),
          swap_((format == PlyFormat::big_endian) != (std::endian::native == std::endian::big)) {}

    std::uint64_t max_row_count(std::uint64_t, std::uint64_t bytes) const {
        return remaining_bytes() / bytes;
    }
    void begin_row() {}
    void end_row() {}
    std::uint64_t remaining_bytes() const { return static_cast<std::uint64_t>(end_ - at_); }
    [[noreturn]] void fail(const std::string& what) const { throw InputError(file_ + ": " + what); }

    double value(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return take<std::int8_t>();
            case PlyType::uint8:
                return take<std::uint8_t>();
            case PlyType::int16:
                return take<std::int16_t>();
            case PlyType::uint16:
                return take<std::uint16_t>();
            case PlyType::int32:
                return take<std::int32_t>();
            case PlyType::uint32:
                return take<std::uint32_t>();
            case PlyType::float32:
                return take<float>();
            case PlyType::float64:
                break;
        }
        return take<double>();
    }

private:
    template <class T>
    T take() {
        if (remaining_bytes() < sizeof(T)) fail("unexpected end of the file");
        std::array<std::uint8_t, sizeof(T)> bytes;
        std::memcpy(bytes.data(), at_, sizeof(T));
        at_ += sizeof(T);
        if (swap_) std::reverse(bytes.begin(), bytes.end());
        return std::bit_cast<T>(bytes);
    }

    const std::uint8_t* at_;
    const std::uint8_t* end_;
    std::string file_;
    bool swap_;
};

// Meaning of a vertex property. Properties with other names are `skipped`.
enum VertexProperty : std::size_t {
    x,
    y,
    z,
    nx,
    ny,
    nz,
    red,
    green,
    blue,
    alpha,
    s,
    t,
    skipped,
    vertex_property_count
};

VertexProperty vertex_property(const PlyProperty& property) {
    static constexpr std::array<std::array<std::string_view, 3>, skipped> names = {
        {{"x", "", ""},
         {"y", "", ""},
         {"z", "", ""},
         {"nx", "", ""},
         {"ny", "", ""},
         {"nz", "", ""},
         {"red", "r", "diffuse_red"},
         {"green", "g", "diffuse_green"},
         {"blue", "b", "diffuse_blue"},
         {"alpha", "a", "diffuse_alpha"},
         {"s", "u", "texture_u"},
         {"t", "v", "texture_v"}}};
    if (property.is_list) return skipped;
    for (std::size_t slot = 0; slot < skipped; ++slot)
        if (std::find(names[slot].begin(), names[slot].end(), property.name) != names[slot].end())
            return static_cast<VertexProperty>(slot);
    return skipped;
}

/// Converts the elements of a PLY file to a part.
/// \tparam Data  AsciiData or BinaryData
template <class Data>
class PlyReader {
public:
    PlyReader(const PlyHeader& header, Data data, const std::string& file, std::vector<std::string>& warnings)
        : header_(header), data_(std::move(data)), file_(file), warnings_(warnings) {}

    Part run() {
        check_elements();
        for (const PlyElement& element : header_.elements) {
            if (element.count == 0) continue;
            check_row_count(element);
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_lists(element, [this](const std::vector<double>& list) { add_face(list); });
            else if (element.name == "tristrips")
                read_lists(element, [this](const std::vector<double>& list) { add_strip(list); });
            else
                for_each_row(element, [&] { skip(element.properties); });
        }
        if (data_.remaining_bytes())
            warnings_.push_back(pluralized(data_.remaining_bytes(), "byte") +
                                " after the last element ignored");
        finish_faces();
        return std::move(part_);
    }

private:
    void check_elements() {
        for (const char* name : {"vertex", "face", "tristrips"}) {
            const auto count = std::count_if(header_.elements.begin(), header_.elements.end(),
                                             [&](const PlyElement& e) { return e.name == name; });
            if (count > 1) throw InputError(file_, "header", std::string("more than one element ") + name);
        }
        for (const PlyElement& element : header_.elements)
            check_index_count(element.count, file_, element.name);
        const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(),
                                         [](const PlyElement& e) { return e.name == "vertex"; });
        if (vertex == header_.elements.end()) throw InputError(file_, "header", "no element vertex");
        vertex_count_ = vertex->count;
        if (header_.has_texture_file) warnings_.push_back("the texture file named in a comment is ignored");
    }

    void check_row_count(const PlyElement& element) {
        std::uint64_t bytes = 0;
        for (const PlyProperty& p : element.properties)
            bytes += ply_type_size(p.is_list ? p.count_type : p.type);
        if (bytes && element.count > data_.max_row_count(element.properties.size(), bytes))
            throw InputError(file_, "element " + element.name,
                             "the file is too short for " + pluralized(element.count, "row"));
    }

    /// Calls row() for each row of an element. Adds the name and index of the row to error messages.
    template <class Row>
    void for_each_row(const PlyElement& element, Row&& row) {
        if (element.properties.empty()) return;
        std::uint64_t i = 0;
        try {
            for (; i < element.count; ++i) {
                data_.begin_row();
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
        if (count && count > data_.max_row_count(1, ply_type_size(property.type)))
            data_.fail("the file is too short for a list of " + std::to_string(count));
        return count;
    }

    void skip(const PlyProperty& property) {
        for (std::uint64_t n = property.is_list ? list_size(property) : 1; n > 0; --n)
            data_.value(property.type);
    }
    void skip(const std::vector<PlyProperty>& properties) {
        for (const PlyProperty& p : properties) skip(p);
    }

    void read_vertices(const PlyElement& element) {
        std::vector<VertexProperty> slots;
        std::array<double, vertex_property_count> scale = {};  // of colours to [0, 1]; 0: no such property
        for (const PlyProperty& p : element.properties) {
            slots.push_back(vertex_property(p));
            scale[slots.back()] = is_integer(p.type) ? 1 / range_of(p.type).high : 1;
        }
        const auto has = [&](std::initializer_list<VertexProperty> all) {
            return std::all_of(all.begin(), all.end(), [&](VertexProperty slot) { return scale[slot] > 0; });
        };
        if (!has({x, y, z})) throw InputError(file_, "element vertex", "must have the properties x, y and z");
        part_.positions.resize(element.count);
        if (has({nx, ny, nz})) part_.normals.resize(element.count);
        if (has({red, green, blue})) part_.colors.resize(element.count);
        if (has({s, t})) part_.uvs.emplace_back(element.count);

        std::array<double, vertex_property_count> row = {};
        std::size_t vertex = 0;
        for_each_row(element, [&] {
            for (std::size_t i = 0; i < slots.size(); ++i) {
                if (slots[i] == skipped)
                    skip(element.properties[i]);
                else
                    row[slots[i]] = data_.value(element.properties[i].type);
            }
            store_vertex(vertex++, row, scale);
        });
    }

    void store_vertex(std::size_t v, const std::array<double, vertex_property_count>& row,
                      const std::array<double, vertex_property_count>& scale) {
        part_.positions[v] = {row[x], row[y], row[z]};
        const auto number = [&](VertexProperty slot) { return static_cast<float>(row[slot]); };
        const auto linear = [&](VertexProperty slot) {
            return static_cast<float>(linear_from_srgb(row[slot] * scale[slot]));
        };
        if (!part_.normals.empty()) part_.normals[v] = {number(nx), number(ny), number(nz)};
        if (!part_.uvs.empty()) part_.uvs[0][v] = {number(s), 1 - number(t)};
        if (part_.colors.empty()) return;
        const double opacity = scale[alpha] > 0 ? row[alpha] * scale[alpha] : 1;
        part_.colors[v] = {linear(red), linear(green), linear(blue), static_cast<float>(opacity)};
    }

    /// Calls use(indices) with the index list of each row of an element.
    template <class Use>
    void read_lists(const PlyElement& element, Use&& use) {
        const auto indices = std::find_if(
            element.properties.begin(), element.properties.end(),
            [](const PlyProperty& p) { return p.name == "vertex_indices" || p.name == "vertex_index"; });
        if (indices == element.properties.end() || !indices->is_list || !is_integer(indices->type))
            throw InputError(file_, "element " + element.name,
                             "must have an integer list property vertex_indices");
        for (const PlyProperty& p : element.properties)
            if (p.name == "texcoord" || p.name == "red")
                warnings_.push_back("'" + p.name + "' of " + element.name +
                                    " is ignored: only vertex properties are supported");
        std::vector<double> list;
        for_each_row(element, [&] {
            for (auto p = element.properties.begin(); p != element.properties.end(); ++p) {
                if (p != indices) {
                    skip(*p);
                    continue;
                }
                list.resize(list_size(*p));
                for (double& i : list) i = data_.value(p->type);
                use(list);
            }
        });
    }

    Index vertex(double index) const {
        if (!(index >= 0 && index < static_cast<double>(vertex_count_)))
            data_.fail("vertex " + std::to_string(static_cast<std::int64_t>(index)) +
                       " is out of range: there are " + std::to_string(vertex_count_));
        return static_cast<Index>(index);
    }

    void add_face(const std::vector<double>& list) {
        for (const double i : list) polygons_.vertices.push_back(vertex(i));
        polygons_.sizes.push_back(static_cast<std::uint32_t>(list.size()));
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
            polygons_.vertices.insert(polygons_.vertices.end(),
                                      {is_reversed ? b : a, is_reversed ? a : b, c});
            polygons_.sizes.push_back(3);
        }
    }

    void finish_faces() {
        check_index_count(polygons_.sizes.size(), file_, "face");
        TriangulatedPolygons split = triangulate_polygons(polygons_, part_.positions);
        if (split.too_few_corners)
            warnings_.push_back(pluralized(split.too_few_corners, "face") +
                                " with fewer than three corners left out");
        check_index_count(split.triangles.size(), file_, "triangle");
        part_.triangles = std::move(split.triangles);
        part_.face_material.assign(part_.triangles.size(), no_index);
        repair_non_finite(part_, file_, split.non_finite, warnings_);
    }

    const PlyHeader& header_;
    Data data_;
    const std::string file_;
    std::vector<std::string>& warnings_;
    Part part_;
    Polygons polygons_;
    std::uint64_t vertex_count_ = 0;
};

}  // namespace

Asset read_ply(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    Asset asset;
    const PlyHeader header = read_ply_header(bytes, file.string());
    const std::span<const std::uint8_t> data = bytes.subspan(header.size);
    asset.parts.push_back(
        header.format == PlyFormat::ascii
            ? PlyReader(header, AsciiData(data, file.string(), header.lines), file.string(), asset.warnings)
                  .run()
            : PlyReader(header, BinaryData(data, file.string(), header.format), file.string(), asset.warnings)
                  .run());
    asset.parts[0].name = file.stem().string();
    return asset;
}

Asset read_ply(const std::filesystem::path& file) { return read_ply(read_file(file), file); }

}  // namespace faqem::detail
