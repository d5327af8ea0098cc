#include "asset/scene/repair.hpp"

#include "asset/scene/messages.hpp"

#include <algorithm>
#include <cstddef>

#include "asset/scene/part_arrays.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

template <class Vector>
void reset(std::vector<Vector>& values, const Vector& neutral, const char* noun, const char* what,
           std::vector<std::string>& warnings) {
    std::uint64_t count = 0;
    for (Vector& v : values) {
        if (is_finite(v)) continue;
        v = neutral;
        ++count;
    }
    if (count) warnings.push_back(pluralized(count, noun) + " with non-finite values set to " + what);
}

std::uint64_t drop_vertices(Part& part) {
    if (std::all_of(part.positions.begin(), part.positions.end(), is_finite<double, 3>)) return 0;
    std::vector<Index> renumbered(part.positions.size(), no_index), vertices, faces;
    for (Index v = 0; v < renumbered.size(); ++v) {
        if (!is_finite(part.positions[v])) continue;
        renumbered[v] = static_cast<Index>(vertices.size());
        vertices.push_back(v);
    }
    const std::size_t before = part.triangles.size();
    for (Index f = 0; f < before; ++f) {
        Triangle& t = part.triangles[f];
        for (Index& v : t) v = renumbered[v];
        if (std::find(t.begin(), t.end(), no_index) == t.end()) faces.push_back(f);
    }
    select_faces(part, faces, part);
    visit_vertex_arrays([&](const VertexArray&, auto& values) { values = gather(values, vertices); }, part);
    return before - faces.size();
}

}  // namespace

void repair_non_finite(Part& part, const std::string& file, std::uint64_t dropped,
                       std::vector<std::string>& warnings) {
    const std::size_t before = part.positions.size();
    dropped += drop_vertices(part);
    const std::size_t vertices = before - part.positions.size();
    if (dropped || vertices)
        warnings.push_back(pluralized(vertices, "vertex") + " with a non-finite position and " +
                           pluralized(dropped, "adjacent face") + " left out");
    if (part.triangles.empty())
        throw InputError(file, "", dropped ? "no faces with finite positions" : "no faces");
    reset(part.normals, {0, 0, 0}, "normal", "zero", warnings);
    for (auto& set : part.uvs) reset(set, {0, 0}, "texture coordinate", "zero", warnings);
    reset(part.colors, {1, 1, 1, 1}, "vertex colour", "white", warnings);
}

}  // namespace faqem::detail
