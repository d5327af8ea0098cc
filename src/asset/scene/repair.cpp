#include "asset/scene/repair.hpp"

#include "asset/scene/messages.hpp"

#include <algorithm>
#include <cstddef>

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

/// Removes the values of vertices whose new index is no_index.
template <class Value>
void compact(std::vector<Value>& values, const std::vector<Index>& renumbered) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t v = 0; v < renumbered.size(); ++v)
        if (renumbered[v] != no_index) values[kept++] = values[v];
    values.resize(kept);
}

std::uint64_t drop_faces(Part& part, const std::vector<Index>& renumbered) {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        Triangle t = part.triangles[f];
        for (Index& v : t) v = renumbered[v];
        if (std::find(t.begin(), t.end(), no_index) != t.end()) continue;
        part.triangles[kept] = t;
        if (!part.face_material.empty()) part.face_material[kept] = part.face_material[f];
        if (!part.face_object.empty()) part.face_object[kept] = part.face_object[f];
        if (!part.face_group.empty()) part.face_group[kept] = part.face_group[f];
        ++kept;
    }
    const std::uint64_t dropped = part.triangles.size() - kept;
    part.triangles.resize(kept);
    if (!part.face_material.empty()) part.face_material.resize(kept);
    if (!part.face_object.empty()) part.face_object.resize(kept);
    if (!part.face_group.empty()) part.face_group.resize(kept);
    return dropped;
}

std::uint64_t drop_vertices(Part& part) {
    std::vector<Index> renumbered(part.positions.size());
    Index next = 0;
    for (std::size_t v = 0; v < renumbered.size(); ++v)
        renumbered[v] = is_finite(part.positions[v]) ? next++ : no_index;
    if (next == renumbered.size()) return 0;
    const std::uint64_t dropped = drop_faces(part, renumbered);
    compact(part.positions, renumbered);
    compact(part.normals, renumbered);
    compact(part.tangents, renumbered);
    for (auto& set : part.uvs) compact(set, renumbered);
    compact(part.colors, renumbered);
    return dropped;
}

}  // namespace

void check_index_count(std::uint64_t count, const std::string& file, const std::string& element) {
    if (count > max_index_count)
        throw InputError(file, element,
                         "there are " + std::to_string(count) + ", more than the " +
                             std::to_string(max_index_count) + " that 32-bit indices can address");
}

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
