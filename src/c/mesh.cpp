#include "c/mesh.hpp"

#include <limits>
#include <string>

#include "faqem/error.hpp"

namespace faqem::c {

namespace {

void require_array(const void* array, std::size_t count, const char* name) {
    if (count >= no_index) throw InputError("", name, "more than 32-bit indices can count");
    if (count > 0 && !array)
        throw InputError("", name,
                         "the array is null, but " + std::to_string(count) + " elements are announced");
}

PositionView positions_of(const faqem_mesh& mesh) {
    if (mesh.positions && mesh.double_positions)
        throw InputError("", "positions", "given both as float and as double");
    const void* given = mesh.positions ? static_cast<const void*>(mesh.positions) : mesh.double_positions;
    require_array(given, mesh.vertex_count, "positions");
    if (mesh.positions) return std::span(mesh.positions, 3 * mesh.vertex_count);
    return std::span(mesh.double_positions, 3 * mesh.vertex_count);
}

template <class Value>
std::span<const Value> optional_array(const Value* array, std::size_t count) {
    return array ? std::span(array, count) : std::span<const Value>();
}

}  // namespace

MeshArrays::MeshArrays(const faqem_mesh& mesh) {
    view.positions = positions_of(mesh);
    require_array(mesh.triangles, mesh.face_count, "triangles");
    view.triangles = std::span(mesh.triangles, 3 * mesh.face_count);
    view.face_groups = optional_array(mesh.face_groups, mesh.face_count);
    view.vertex_locks = optional_array(mesh.vertex_locks, mesh.vertex_count);
    view.vertex_weights = optional_array(mesh.vertex_weights, mesh.vertex_count);
    if ((mesh.corner_values != nullptr) != (mesh.corner_width > 0))
        throw InputError("", "corner_values", "an array needs a corner_width, and a corner_width an array");
    if (!mesh.corner_values) return;
    if (mesh.face_count > std::numeric_limits<std::size_t>::max() / 3 / mesh.corner_width)
        throw InputError("", "corner_values", "more than memory can hold");
    corners.width = mesh.corner_width;
    corners.values.assign(mesh.corner_values, mesh.corner_values + 3 * mesh.face_count * mesh.corner_width);
    view.attributes = &corners;
}

}  // namespace faqem::c
