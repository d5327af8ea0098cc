#include "asset/formats/polygon_content.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "asset/formats/referenced_images.hpp"
#include "asset/scene/corner_vertices.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/repair.hpp"

namespace faqem::detail {
namespace {

bool has_value(Index index) { return index != no_index; }

/// Converts the content of one file.
class PolygonConverter {
public:
    PolygonConverter(PolygonContent content, const std::filesystem::path& file,
                     std::vector<std::string> warnings)
        : content_(std::move(content)), file_(file) {
        asset_.warnings = std::move(warnings);
        asset_.not_understood = std::move(content_.not_understood);
    }

    Asset run(const std::vector<std::string>& texture_files) {
        Polygons& polygons = faces_.polygons;
        check_index_count(polygons.sizes.size() + content_.strips.sizes.size(), file_.string(), "face");
        add_materials(texture_files);
        choose_colors();
        repeat_vertices();
        const std::size_t faces = polygons.sizes.size();
        const Polygons& strips = content_.strips;
        polygons.vertices.insert(polygons.vertices.end(), strips.vertices.begin(), strips.vertices.end());
        polygons.sizes.insert(polygons.sizes.end(), strips.sizes.begin(), strips.sizes.end());
        TriangulatedPolygons split = triangulate_polygons(polygons, part_.positions);
        add_counted(asset_.warnings, split.too_few_corners, "face",
                    " with fewer than three corners left out");
        check_index_count(split.triangles.size(), file_.string(), "triangle");
        part_.triangles = std::move(split.triangles);
        part_.face_material.assign(part_.triangles.size(), no_index);
        for (std::size_t t = 0; t < part_.triangles.size() && !material_.empty(); ++t)
            if (split.source_polygon[t] < faces) part_.face_material[t] = material_[split.source_polygon[t]];
        repair_non_finite(part_, file_.string(), split.non_finite, asset_.warnings);
        part_.name = file_.stem().string();
        asset_.parts.push_back(std::move(part_));
        return std::move(asset_);
    }

private:
    void warn(const std::string& what) { asset_.warnings.push_back(what); }

    /// Adds the materials of the texture files that faces refer to, in the order of their numbers, and sets material_.
    void add_materials(const std::vector<std::string>& texture_files) {
        if (texture_files.empty()) return;
        if (faces_.uvs.empty() && part_.uvs.empty())
            return warn("texture files are not read: there are no texture coordinates");
        const std::vector<std::size_t> numbers = texture_numbers(texture_files.size());
        FileFinder finder(file_.parent_path());
        ReferencedImages images(asset_, finder);
        std::vector<Index> added(texture_files.size() + 1, no_index);  // the last one for no texture
        for (std::size_t i = 0; i < texture_files.size(); ++i) {
            if (std::ranges::find(numbers, i) == numbers.end()) continue;
            ReferencedImage* image = images.read("TextureFile", texture_files[i], {});
            if (!image) continue;
            Material material;
            material.name = image->image.name;
            material.metallic = 0;
            material.base_color_texture.image = images.use(*image);
            added[i] = static_cast<Index>(asset_.materials.size());
            asset_.materials.push_back(std::move(material));
        }
        for (const std::size_t number : numbers) material_.push_back(added[number]);
    }

    /// The texture of each face; `count` for none.
    std::vector<std::size_t> texture_numbers(std::size_t count) {
        std::vector<std::size_t> numbers(faces_.polygons.sizes.size(), 0);
        std::uint64_t unknown = 0;
        for (std::size_t f = 0; f < numbers.size(); ++f) {
            const bool has_uvs = faces_.has_uvs.empty() || faces_.has_uvs[f];
            const double number = faces_.textures.empty() ? 0 : faces_.textures[f];
            const bool is_known = number >= 0 && number < static_cast<double>(count);
            unknown += has_uvs && !is_known && !(number < 0);
            numbers[f] = has_uvs && is_known ? static_cast<std::size_t>(number) : count;
        }
        add_counted(asset_.warnings, unknown, "face",
                    " with the number of a texture that the file does not name");
        return numbers;
    }

    bool is_textured(std::size_t face) const { return !material_.empty() && has_value(material_[face]); }

    /// Removes the colours that textures replace, and face colours beside vertex colours.
    void choose_colors() {
        if (!faces_.colors.empty() && !part_.colors.empty()) {
            warn("face colours are ignored beside vertex colours");
            faces_.colors.clear();
        }
        const auto textured = std::ranges::count_if(material_, has_value);
        if (textured == 0 || (faces_.colors.empty() && part_.colors.empty())) return;
        warn("colours of " + pluralized(static_cast<std::uint64_t>(textured), "face") +
             " with a texture left out");
        const bool all = content_.strips.sizes.empty() &&
                         static_cast<std::size_t>(textured) == faces_.polygons.sizes.size();
        if (all) {
            faces_.colors.clear();
            part_.colors.clear();
        }
    }

    /// Repeats the vertices whose corners differ in texture coordinates or colour.
    void repeat_vertices() {
        const bool has_colors = !faces_.colors.empty() || !part_.colors.empty();
        const bool has_white_faces = has_colors && std::ranges::any_of(material_, has_value);
        if (faces_.uvs.empty() && faces_.colors.empty() && !has_white_faces) return;
        const std::size_t old_count = part_.positions.size();
        check_index_count(faces_.polygons.vertices.size(), file_.string(), "corner");
        UniqueValues<Vec2f> uvs;
        UniqueValues<Vec4f> colors;
        CornerVertices vertices(old_count);
        std::size_t corner = 0;
        for (std::size_t f = 0; f < faces_.polygons.sizes.size(); ++f) {
            Index color = no_index;  // that of the vertex
            if (has_colors && is_textured(f))
                color = colors.insert({1, 1, 1, 1});
            else if (!faces_.colors.empty())
                color = colors.insert(faces_.colors[f]);
            for (std::uint32_t i = 0; i < faces_.polygons.sizes[f]; ++i, ++corner) {
                Index& vertex = faces_.polygons.vertices[corner];
                const Index uv = faces_.uvs.empty() ? no_index : uvs.insert(faces_.uvs[corner]);
                vertex = vertices.vertex({vertex, uv, color});
                if (vertices.count() > max_index_count)
                    check_index_count(vertices.count(), file_.string(), "corner");
            }
        }
        copy_attributes(vertices, uvs.values(), colors.values());
    }

    void copy_attributes(const CornerVertices& vertices, const std::vector<Vec2f>& uvs,
                         const std::vector<Vec4f>& colors) {
        const std::size_t positions = part_.positions.size();
        if (!faces_.uvs.empty()) part_.uvs.assign(1, std::vector<Vec2f>(positions, {0, 0}));
        if (!faces_.colors.empty()) part_.colors.assign(positions, {1, 1, 1, 1});
        add_corner_vertices(part_, vertices);
        for (std::size_t v = 0; v < part_.positions.size(); ++v) {
            const auto [position, uv, color] = vertices.corner(v);
            if (has_value(uv)) part_.uvs[0][v] = uvs[uv];
            if (has_value(color)) part_.colors[v] = colors[color];
        }
    }

    PolygonContent content_;
    Part& part_ = content_.part;
    PolygonFaces& faces_ = content_.faces;
    const std::filesystem::path& file_;
    Asset asset_;
    std::vector<Index> material_;  // by face; empty: none has one
};

}  // namespace

Asset polygon_asset(PolygonContent content, const std::vector<std::string>& texture_files,
                    const std::filesystem::path& file, std::vector<std::string> warnings) {
    return PolygonConverter(std::move(content), file, std::move(warnings)).run(texture_files);
}

}  // namespace faqem::detail
