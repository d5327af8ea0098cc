#include "asset/formats/face_colors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asset/image/srgb.hpp"
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

void divide_byte_colors(double largest, std::initializer_list<std::vector<Vec4f>*> colors,
                        std::vector<std::string>& warnings) {
    constexpr double largest_unit_color = 2;
    if (!(largest > largest_unit_color)) return;
    warnings.push_back("colours stored as numbers up to " +
                       std::to_string(static_cast<int>(std::ceil(largest))) + " are divided by 255");
    for (std::vector<Vec4f>* const list : colors) {
        for (Vec4f& c : *list) {
            for (std::size_t k = 0; k < 3; ++k)
                c[k] = static_cast<float>(linear_from_srgb(srgb_from_linear(c[k]) / 255));
            c[3] = std::min(c[3] / 255, 1.0f);
        }
    }
}

}  // namespace faqem::detail
