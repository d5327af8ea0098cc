#include "capi/c_mesh.hpp"

#include <limits>
#include <string>

#include "faqem/error.hpp"

namespace faqem::capi {

namespace {

void require_array(const void* array, std::size_t count, const char* name) {
    if (count >= no_index) throw InputError("", name, "more elements than 32-bit indices can address");
    if (count > 0 && !array)
        throw InputError("", name,
                         "the array is null, but " + std::to_string(count) + " elements are expected");
}

/// Creates a view of triples; a stride or step of 0 means contiguous elements.
template <class View, class Number>
View view_of(const Number* first, std::size_t count, std::size_t stride, std::size_t step) {
    return View(first, count, stride > 0 ? stride : 3 * sizeof(Number), step > 0 ? step : sizeof(Number));
}

PositionView positions_of(const faqem_mesh& mesh) {
    if (mesh.positions && mesh.double_positions)
        throw InputError("", "positions", "given both as float and as double, but one array is expected");
    const void* given = mesh.positions ? static_cast<const void*>(mesh.positions) : mesh.double_positions;
    require_array(given, mesh.vertex_count, "positions");
    const auto view = [&](const auto* first) {
        return view_of<PositionView>(first, mesh.vertex_count, mesh.position_stride, mesh.position_step);
    };
    return mesh.positions ? view(mesh.positions) : view(mesh.double_positions);
}

TriangleView triangles_of(const faqem_mesh& mesh) {
    if (mesh.triangles && mesh.short_triangles)
        throw InputError("", "triangles", "given both with 32 and with 16 bits, but one array is expected");
    const void* given = mesh.triangles ? static_cast<const void*>(mesh.triangles) : mesh.short_triangles;
    require_array(given, mesh.face_count, "triangles");
    const auto view = [&](const auto* first) {
        return view_of<TriangleView>(first, mesh.face_count, mesh.triangle_stride, mesh.triangle_step);
    };
    return mesh.triangles ? view(mesh.triangles) : view(mesh.short_triangles);
}

template <class Value>
std::span<const Value> optional_array(const Value* array, std::size_t count) {
    return array ? std::span(array, count) : std::span<const Value>();
}

}  // namespace

MeshArrays::MeshArrays(const faqem_mesh& mesh) {
    view.positions = positions_of(mesh);
    view.triangles = triangles_of(mesh);
    view.face_groups = optional_array(mesh.face_groups, mesh.face_count);
    view.vertex_locks = optional_array(mesh.vertex_locks, mesh.vertex_count);
    view.vertex_weights = optional_array(mesh.vertex_weights, mesh.vertex_count);
    if ((mesh.corner_values != nullptr) != (mesh.corner_width > 0))
        throw InputError("", "corner_values", "corner_values and corner_width must both be set, or neither");
    if (!mesh.corner_values) return;
    if (mesh.face_count > std::numeric_limits<std::size_t>::max() / 3 / mesh.corner_width)
        throw InputError("", "corner_values", "more values than the address space can hold");
    corners.width = mesh.corner_width;
    corners.values.assign(mesh.corner_values, mesh.corner_values + 3 * mesh.face_count * mesh.corner_width);
    view.attributes = &corners;
}

}  // namespace faqem::capi
