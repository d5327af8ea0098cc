#include "asset/formats/face_colors.hpp"

#include <cstddef>

#include "asset/scene/corner_vertices.hpp"
#include "asset/scene/repair.hpp"

namespace faqem::detail {

void set_face_colors(Part& part, Polygons& polygons, const std::vector<Vec4f>& colors,
                     const std::string& file) {
    UniqueValues<Vec4f> distinct;
    CornerVertices vertices(part.positions.size());
    std::size_t corner = 0;
    for (std::size_t f = 0; f < polygons.sizes.size(); ++f) {
        const Index color = distinct.insert(colors[f]);
        for (std::uint32_t i = 0; i < polygons.sizes[f]; ++i, ++corner) {
            polygons.vertices[corner] = vertices.vertex({polygons.vertices[corner], color, no_index});
            if (vertices.count() > max_index_count) check_index_count(vertices.count(), file, "corner");
        }
    }
    part.colors.assign(part.positions.size(), {1, 1, 1, 1});
    add_corner_vertices(part, vertices);
    for (std::size_t v = 0; v < part.colors.size(); ++v) {
        const Index color = vertices.corner(v)[1];
        if (color != no_index) part.colors[v] = distinct.values()[color];
    }
}

}  // namespace faqem::detail
