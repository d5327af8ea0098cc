#include "asset/scene/repair.hpp"

#include <map>
#include <type_traits>

#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"

namespace faqem::detail {
namespace {

std::uint64_t drop_vertices(Part& part) {
    if (std::ranges::all_of(part.positions, is_finite<double, 3>)) return 0;
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
        if (std::ranges::find(t, no_index) == t.end()) faces.push_back(f);
    }
    select_faces(part, faces, part);
    visit_vertex_arrays([&](const VertexArray&, auto& values) { values = gather(values, vertices); }, part);
    return before - faces.size();
}

}  // namespace

std::uint64_t repair_vertices(Part& part, std::uint64_t dropped, std::vector<std::string>& warnings) {
    const std::size_t before = part.positions.size();
    dropped += drop_vertices(part);
    const std::size_t vertices = before - part.positions.size();
    if (dropped || vertices)
        warnings.push_back(pluralized(vertices, "vertex") + " with a non-finite position and " +
                           pluralized(dropped, "adjacent face") + " left out");
    std::map<std::string, std::uint64_t> counts;
    visit_vertex_arrays(
        [&](const VertexArray& array, auto& values) {
            typename std::decay_t<decltype(values)>::value_type neutral = {};
            const bool is_color = array.name == "colors";
            if (is_color) neutral.fill(1);
            if (const std::uint64_t count = reset_non_finite(values, neutral))
                counts[array.title() + (is_color ? " set to white" : " set to zero")] += count;
        },
        part);
    for (const auto& [what, count] : counts)
        warnings.push_back(pluralized(count, "non-finite vector") + " of " + what);
    return dropped;
}

void repair_non_finite(Part& part, const std::string& file, std::uint64_t dropped,
                       std::vector<std::string>& warnings) {
    dropped = repair_vertices(part, dropped, warnings);
    if (part.triangles.empty())
        throw InputError(file, "", dropped ? "no faces with finite positions" : "no faces");
}

}  // namespace faqem::detail
