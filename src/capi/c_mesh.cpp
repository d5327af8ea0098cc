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

/// Creates a view of triples in one of two arrays; a stride or step of 0 means contiguous elements.
/// \param kinds  for the message that both are given
template <class View, class Number, class OtherNumber>
View view_of(const Number* one, const OtherNumber* other, std::size_t count, std::size_t stride,
             std::size_t step, const char* name, const std::string& kinds) {
    if (one && other) throw InputError("", name, "given both " + kinds + ", but one array is expected");
    require_array(one ? static_cast<const void*>(one) : other, count, name);
    const auto view = [&](const auto* first) {
        return View(first, count, stride > 0 ? stride : 3 * sizeof *first, step > 0 ? step : sizeof *first);
    };
    return one ? view(one) : view(other);
}

}  // namespace

MeshArrays::MeshArrays(const faqem_mesh& mesh) {
    view.positions =
        view_of<PositionView>(mesh.positions, mesh.double_positions, mesh.vertex_count, mesh.position_stride,
                              mesh.position_step, "positions", "as float and as double");
    view.triangles =
        view_of<TriangleView>(mesh.triangles, mesh.short_triangles, mesh.face_count, mesh.triangle_stride,
                              mesh.triangle_step, "triangles", "with 32 and with 16 bits");
    view.face_groups = {mesh.face_groups, mesh.face_groups ? mesh.face_count : 0};
    view.vertex_locks = {mesh.vertex_locks, mesh.vertex_locks ? mesh.vertex_count : 0};
    view.vertex_weights = {mesh.vertex_weights, mesh.vertex_weights ? mesh.vertex_count : 0};
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
