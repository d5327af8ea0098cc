#include "asset/formats/formats.hpp"

#include "asset/scene/messages.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string_view>

#include "asset/formats/mtl.hpp"
#include "asset/formats/obj_colors.hpp"
#include "asset/formats/obj_smoothing.hpp"
#include "asset/formats/obj_tiles.hpp"
#include "asset/formats/referenced_images.hpp"
#include "asset/scene/corner_vertices.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/repair.hpp"
#include "asset/scene/triangulate.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// Indices of the position, UV and normal of a face corner; no_index if absent.
using ObjCorner = CornerKey;

constexpr std::array<const char*, 3> corner_index_names = {"position", "texture coordinate", "normal"};

/// The statements of an OBJ file as written, with indices starting at 0.
struct ObjStatements {
    std::vector<Vec3> positions;
    StoredPrecision precision;
    std::vector<Vec4f> colors;  // empty, or one per position
    std::vector<Vec2f> uvs;
    std::vector<Vec3f> normals;
    std::vector<ObjCorner> corners;
    std::vector<std::uint32_t> sizes;  // number of corners of each face
    std::vector<Index> face_material;  // indices into material_names
    std::vector<std::string> material_names;
    std::vector<std::string> libraries;
    std::vector<Index> face_object;  // indices into objects; no_index before the first one
    std::vector<std::string> objects;
    std::vector<Index> face_group;  // indices into groups; no_index for the default group
    std::vector<std::string> groups;
    std::vector<std::int64_t> face_smoothing;
    IgnoredStatements ignored;
};

/// Parser of an OBJ file.
class ObjParser {
public:
    ObjParser(std::span<const std::uint8_t> text, const std::string& file, std::vector<std::string>& warnings)
        : in_(text, file, Continuation::yes), warnings_(warnings) {}

    ObjStatements run() {
        for (; !in_.at_end(); in_.next_line()) {
            if (ObjColors::is_block(in_.remaining()))
                colors_.read_block(in_);
            else if (!in_.at_line_end())
                statement(in_.word());
        }
        check_forward_references();
        out_.colors = colors_.finish(warnings_);
        add_warnings();
        return std::move(out_);
    }

private:
    void statement(std::string_view key) {
        if (key == "v")
            position();
        else if (key == "f")
            face();
        else if (key == "vt")
            uv();
        else if (key == "vn")
            normal();
        else if (key == "usemtl")
            material_ = number_of(in_.rest_of_line(), material_numbers_, out_.material_names);
        else if (key == "mtllib")
            out_.libraries.push_back(in_.rest_of_line());
        else if (key == "o")
            object_ = number_of(in_.rest_of_line(), object_numbers_, out_.objects);
        else if (key == "l" || key == "p")
            ++lines_and_points_;
        else if (key == "g")
            group();
        else if (key == "s")
            smoothing_ = smoothing_group(in_.word());
        else if (unknown_++ == 0)
            first_unknown_ = TextScanner::quoted(key) + " in line " + std::to_string(in_.line());
    }

    void position() {
        std::array<double, 7> n;
        std::size_t count = 0;
        while (!in_.at_line_end()) {
            if (count == n.size()) in_.fail("v has more than 7 numbers");
            n[count] = count < 3 ? read_coordinate(in_, out_.precision) : in_.number<double>();
            ++count;
        }
        if (count < 3 || count == 5)
            in_.fail("v has " + std::to_string(count) + " numbers; expected 3, 4, 6 or 7");
        weights_ += (count == 4 && n[3] != 1) || count == 7;
        out_.positions.push_back({n[0], n[1], n[2]});
        colors_.add_position(std::span(n).subspan(3, count >= 6 ? 3 : 0));
    }

    void uv() {
        Vec2f uv = {in_.number<float>(), 0};
        if (!in_.at_line_end()) uv[1] = in_.number<float>();
        if (!in_.at_line_end()) in_.number<float>();
        end_of_statement("vt");
        out_.uvs.push_back({uv[0], 1 - uv[1]});
    }

    void normal() {
        Vec3f n;
        for (float& x : n) x = in_.number<float>();
        end_of_statement("vn");
        out_.normals.push_back(n);
    }

    void group() {
        const std::string name = in_.rest_of_line();
        const bool is_default = name.empty() || name == default_group_name;
        group_ = is_default ? no_index : number_of(name, group_numbers_, out_.groups);
    }

    void end_of_statement(const char* key) {
        if (!in_.at_line_end())
            in_.fail("unexpected " + TextScanner::quoted(in_.word()) + " at the end of " + key);
    }

    void face() {
        colors_.add_face();
        const std::size_t first = out_.corners.size();
        while (!in_.at_line_end()) out_.corners.push_back(corner());
        const std::size_t count = out_.corners.size() - first;
        if (count > max_index_count)  // avoids building the message for every face
            check_index_count(count, in_.file(), "line " + std::to_string(in_.line()) + ": corner");
        out_.sizes.push_back(static_cast<std::uint32_t>(count));
        out_.face_material.push_back(material_);
        out_.face_object.push_back(object_);
        out_.face_group.push_back(group_);
        out_.face_smoothing.push_back(smoothing_);
    }

    /// Parses v, v/t, v//n or v/t/n. Some exporters write `v/` and `v/t/`, where the index after the last
    /// slash counts as absent.
    ObjCorner corner() {
        ObjCorner corner = {no_index, no_index, no_index};
        corner[0] = index(0);
        for (std::size_t kind = 1; kind < 3 && in_.accept('/'); ++kind)
            if (!in_.at_word_end() && !in_.remaining().starts_with('/')) corner[kind] = index(kind);
        if (!in_.at_word_end())
            in_.fail(TextScanner::quoted(in_.word()) + " is not part of a valid face corner");
        return corner;
    }

    std::size_t count_of(std::size_t kind) const {
        return kind == 0 ? out_.positions.size() : kind == 1 ? out_.uvs.size() : out_.normals.size();
    }

    Index index(std::size_t kind) {
        std::int64_t number = 0;
        if (!in_.accept_integer(number)) in_.fail(TextScanner::quoted(in_.word()) + " is not an index");
        if (number == 0)
            in_.fail(std::string("index 0 of a ") + corner_index_names[kind] + ": indices start at 1");
        const std::size_t count = count_of(kind);
        if (number < 0) {
            if (number < -static_cast<std::int64_t>(count)) out_of_range(kind, number, count, in_.line());
            return static_cast<Index>(static_cast<std::int64_t>(count) + number);
        }
        if (number > static_cast<std::int64_t>(max_index_count))
            out_of_range(kind, number, count, in_.line());
        // Elements later in the file may be referenced; this is checked at the end of the file.
        if (static_cast<std::size_t>(number) > count && number > highest_[kind].number)
            highest_[kind] = {number, in_.line()};
        return static_cast<Index>(number - 1);
    }

    [[noreturn]] void out_of_range(std::size_t kind, std::int64_t number, std::size_t count,
                                   std::uint64_t line) const {
        throw InputError(in_.file(), "line " + std::to_string(line),
                         std::string("index ") + std::to_string(number) + " of a " +
                             corner_index_names[kind] + " is out of range: there " +
                             (count == 1 ? "is " : "are ") + std::to_string(count));
    }

    void check_forward_references() const {
        for (std::size_t kind = 0; kind < 3; ++kind)
            if (highest_[kind].number > static_cast<std::int64_t>(count_of(kind)))
                out_of_range(kind, highest_[kind].number, count_of(kind), highest_[kind].line);
    }

    using Numbers = std::map<std::string, Index>;

    /// Index of a name; new ones are appended.
    static Index number_of(const std::string& name, Numbers& numbers, std::vector<std::string>& names) {
        const auto [entry, is_new] = numbers.try_emplace(name, static_cast<Index>(names.size()));
        if (is_new) names.push_back(name);
        return entry->second;
    }

    void add_warnings() {
        add_counted(warnings_, lines_and_points_, "line or point statement",
                    " ignored: only faces are supported");
        add_counted(warnings_, unknown_, "unknown statement", " ignored, first " + first_unknown_);
        add_counted(warnings_, weights_, "position", " with a weight or alpha, which is ignored");
    }

    struct ForwardReference {
        std::int64_t number = 0;
        std::uint64_t line = 0;
    };

    TextScanner in_;
    std::vector<std::string>& warnings_;
    ObjStatements out_;
    ObjColors colors_;
    Numbers material_numbers_, object_numbers_, group_numbers_;
    Index material_ = no_index, object_ = no_index, group_ = no_index;
    std::array<ForwardReference, 3> highest_;  // largest forward reference of each kind
    std::uint64_t lines_and_points_ = 0, unknown_ = 0, weights_ = 0;
    std::int64_t smoothing_ = unknown_smoothing;
    std::string first_unknown_;
};

/// Whether a corner has an index of a kind: 1 for UVs, 2 for normals.
bool has_indices(const ObjStatements& in, std::size_t kind) {
    return std::ranges::any_of(in.corners, [kind](const ObjCorner& c) { return c[kind] != no_index; });
}

void fill_vertices(Part& part, const ObjStatements& in, const CornerVertices& corner_vertices) {
    const std::size_t count = corner_vertices.count();
    part.positions.resize(count);
    if (!in.colors.empty()) part.colors.resize(count);
    const bool has_uvs = has_indices(in, 1), has_normals = has_indices(in, 2);
    if (has_uvs) part.uvs.emplace_back(count, Vec2f{0, 0});
    if (has_normals) part.normals.resize(count, {0, 0, 0});
    for (std::size_t v = 0; v < count; ++v) {
        const ObjCorner c = corner_vertices.corner(v);
        part.positions[v] = in.positions[c[0]];
        if (!in.colors.empty()) part.colors[v] = in.colors[c[0]];
        if (c[1] != no_index) part.uvs[0][v] = in.uvs[c[1]];
        if (c[2] != no_index) part.normals[v] = in.normals[c[2]];
    }
}

/// Adds the objects that have faces, if there are several. Faces before the first object belong to one with the name of
/// the file.
void add_objects(Part& part, const ObjStatements& in, const std::vector<Index>& source_polygon,
                 const std::string& stem) {
    std::vector<Index> objects = gather(in.face_object, source_polygon);
    std::vector<std::string> names = in.objects;
    std::ranges::replace(objects, no_index, static_cast<Index>(names.size()));
    names.push_back(stem);
    set_objects(part, objects, names);
}

/// Adds the used materials in the order of their first use by a face.
void add_materials(Asset& asset, const ObjStatements& in, const std::map<std::string, MtlMaterial>& libraries,
                   FileFinder& finder) {
    std::vector<Index>& of_face = asset.parts[0].face_material;
    ReferencedImages images(asset, finder);
    std::vector<Index> added(in.material_names.size(), no_index);
    for (Index& m : of_face) {
        if (m == no_index) continue;
        if (added[m] == no_index) {
            const std::string& name = in.material_names[m];
            const auto known = libraries.find(name);
            MtlMaterial unknown;
            unknown.values.name = name;
            unknown.values.metallic = 0;
            if (known == libraries.end())
                asset.warnings.push_back("material '" + name + "' is not defined in any readable library");
            added[m] = add_mtl_material(asset, images, known == libraries.end() ? unknown : known->second);
        }
        m = added[m];
    }
    if (!libraries.empty() && asset.materials.empty())
        asset.warnings.push_back("material libraries are referenced, but no face uses a material (usemtl)");
}

/// The smoothing that all faces have if no corner has a normal.
Smoothing common_smoothing(const ObjStatements& in) {
    const std::vector<std::int64_t>& groups = in.face_smoothing;
    if (has_indices(in, 2) || groups.empty() || groups[0] == unknown_smoothing ||
        std::ranges::any_of(groups, [&](std::int64_t group) { return group != groups[0]; }))
        return Smoothing::unknown;
    return groups[0] == 0 ? Smoothing::off : Smoothing::on;
}

}  // namespace

Asset read_obj(std::span<const std::uint8_t> text, const std::filesystem::path& file) {
    Asset asset;
    Part& part = asset.parts.emplace_back();
    ObjStatements in = ObjParser(text, file.string(), asset.warnings).run();
    asset.precision = in.precision;
    check_index_count(in.positions.size(), file.string(), "v");
    check_index_count(in.sizes.size(), file.string(), "f");
    asset.smoothing = common_smoothing(in);
    add_smoothed_normals(in.positions, in.sizes, in.face_smoothing, in.corners, in.normals);
    check_index_count(in.normals.size(), file.string(), "normal");
    FileFinder finder(file.parent_path());
    auto libraries = read_libraries(in.libraries, file, finder, asset.warnings, in.ignored);
    divide_into_tiles(in.sizes, in.corners, in.face_material, in.material_names, in.uvs, libraries,
                      asset.warnings);
    part.name = in.objects.empty() || in.objects[0].empty() ? file.stem().string() : in.objects[0];

    CornerVertices corner_vertices(in.positions.size());
    Polygons polygons;
    polygons.sizes = std::move(in.sizes);
    polygons.vertices.reserve(in.corners.size());
    for (const ObjCorner& c : in.corners) {
        polygons.vertices.push_back(corner_vertices.vertex(c));
        if (corner_vertices.count() > max_index_count)
            check_index_count(corner_vertices.count(), file.string(), "corner");
    }
    fill_vertices(part, in, corner_vertices);
    TriangulatedPolygons split = triangulate_polygons(polygons, part.positions);
    add_counted(asset.warnings, split.too_few_corners, "face", " with fewer than three corners left out");
    part.triangles = std::move(split.triangles);
    check_index_count(part.triangles.size(), file.string(), "triangle");
    part.face_material = gather(in.face_material, split.source_polygon);
    add_objects(part, in, split.source_polygon, file.stem().string());
    set_face_names(part, group_array, gather(in.face_group, split.source_polygon), in.groups);
    if (part.group_names.empty()) part.face_group.clear();
    repair_non_finite(part, file.string(), split.non_finite, asset.warnings);
    add_materials(asset, in, libraries, finder);
    asset.not_understood = ignored_messages(in.ignored);
    return asset;
}

}  // namespace faqem::detail
