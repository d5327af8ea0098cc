#pragma once
/// \file
/// Triangle meshes as plain arrays: views of the caller's arrays for input, and meshes that own their arrays.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "faqem/error.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN

/// Index of a vertex or a face. Corner c of face f has the number 3 * f + c, computed with 64 bits.
using Index = std::uint32_t;

/// The absence of an index.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

using Vec2f = std::array<float, 2>;
using Vec3f = std::array<float, 3>;
using Vec4f = std::array<float, 4>;
using Vec3 = std::array<double, 3>;

/// Three vertex indices, counter-clockwise as seen from outside.
using Triangle = std::array<Index, 3>;

namespace detail {

/// Layout of an array of triples in bytes: number k of element i begins at i * stride + k * step.
struct Layout {
    std::size_t count, stride, step, number_size;
};

/// Checks that no two numbers share bytes. Such layouts are mistakes, such as a stride in floats instead of bytes, and
/// would give other points. The distance of two numbers is d * stride - e * step, where d is the difference of their
/// elements and e, 0 to 2, that of their numbers; for each e the multiples of the stride around e * step are the
/// closest ones. O(1)
/// \throws InputError  numbers overlap, or the array is larger than the address space
inline void check_layout(const Layout& layout, const char* name) {
    const auto [count, stride, step, size] = layout;
    if (count == 0) return;
    const auto fail = [&](const std::string& what) {
        throw InputError("", name,
                         "with a stride of " + std::to_string(layout.stride) + " bytes and a step of " +
                             std::to_string(layout.step) + " bytes " + what);
    };
    const std::size_t available = std::numeric_limits<std::size_t>::max() - size;
    if (step > available / 2 || (count > 1 && stride > (available - 2 * step) / (count - 1)))
        fail("the array is larger than the address space");
    const auto overlap = [&](std::size_t number, std::size_t element) {
        fail("number " + std::to_string(number) + " of element 0 overlaps number 0 of element " +
             std::to_string(element));
    };
    if (count > 1 && stride < size) overlap(0, 1);
    for (std::size_t e = 1; e <= 2; ++e) {
        const std::size_t offset = e * step;
        const std::size_t below = count > 1 ? std::min(offset / stride, count - 1) : 0;
        if (offset - below * stride < size) overlap(e, below);
        if (below + 1 < count && (below + 1) * stride - offset < size) overlap(e, below + 1);
    }
}

template <class Array>
using ElementOf = std::remove_cvref_t<decltype(*std::data(std::declval<const Array&>()))>;

template <class Element, class... Numbers>
inline constexpr bool is_any_of = (std::is_same_v<Element, Numbers> || ...);

/// A contiguous array (vector, span ...) of numbers of these types, or of triples of them.
template <class Array, class... Numbers>
concept TripleArray = is_any_of<ElementOf<Array>, Numbers..., std::array<Numbers, 3>...>;

template <class Array>
auto first_number(const Array& array) {
    if constexpr (std::is_arithmetic_v<ElementOf<Array>>) {
        return std::data(array);
    } else {
        return std::size(array) == 0 ? nullptr : std::data(array)->data();
    }
}

/// Number of triples in an array. \throws InputError  it is flat, and its length is no multiple of 3
template <class Array>
std::size_t triple_count(const Array& array, const char* name) {
    const std::size_t length = std::size(array);
    if constexpr (!std::is_arithmetic_v<ElementOf<Array>>) return length;
    if (length % 3 != 0)
        throw InputError("", name, "has " + std::to_string(length) + " numbers, which is no multiple of 3");
    return length / 3;
}

/// Checks the vertex indices of a face. Indices from 2^31 on are shown as the negative ones that they may come from.
/// \throws InputError  an index is not below the number of vertices
inline void check_indices(const Triangle& t, std::size_t face, std::size_t vertices) {
    for (const Index v : t) {
        if (v < vertices) continue;
        throw InputError("", "face " + std::to_string(face),
                         "vertex index " + std::to_string(static_cast<std::int32_t>(v)) +
                             " is out of range: there are " + std::to_string(vertices) + " vertices");
    }
}

/// View of triples of numbers, which are stored as one of two types.
/// \tparam Value  type of the numbers that are returned
template <class Value, class Large, class Small>
class TripleView {
public:
    TripleView() = default;

    /// Number of triples.
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }

    std::array<Value, 3> operator[](std::size_t i) const {
        const auto* at = static_cast<const std::byte*>(data_) + i * stride_;
        if (is_small_) return {read<Small>(at), read<Small>(at + step_), read<Small>(at + 2 * step_)};
        return {read<Large>(at), read<Large>(at + step_), read<Large>(at + 2 * step_)};
    }

protected:
    /// \throws InputError  numbers overlap
    template <class Number>
    TripleView(const Number* first, std::size_t count, std::size_t stride, std::size_t step, const char* name)
        : data_(first),
          size_(count),
          stride_(stride),
          step_(step),
          is_small_(sizeof(Number) == sizeof(Small)) {
        check_layout({count, stride, step, sizeof(Number)}, name);
    }

private:
    template <class Number>
    static Value read(const std::byte* at) {
        Number value;
        std::memcpy(&value, at, sizeof value);  // NOLINT(clang-analyzer-core.NonNullParamChecker): i < size()
        return value;
    }

    const void* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t stride_ = 0, step_ = 0;  // bytes
    bool is_small_ = false;
};

}  // namespace detail

/// View of the caller's vertex positions, float or double: packed, interleaved with other data, or
/// column-major. Does not copy or own them; they must outlive the view.
class PositionView : public detail::TripleView<double, double, float> {
public:
    PositionView() = default;
    /// Triples, or a flat array x0 y0 z0 x1 ... \throws InputError  its length is no multiple of 3
    template <detail::TripleArray<double, float> Array>
    PositionView(const Array& p)
        : PositionView(detail::first_number(p), detail::triple_count(p, "positions"),
                       3 * sizeof *detail::first_number(p)) {}

    /// Any layout in which no two numbers overlap. For an array of structs Vertex the stride is sizeof(Vertex). For a
    /// column-major matrix with one row per vertex the stride is sizeof(double), and the step sizeof(double) * rows.
    /// \param first   x of the first vertex; need not be aligned
    /// \param count   number of vertices
    /// \param stride  bytes from one vertex to the next
    /// \param step    bytes from x to y, and from y to z
    /// \throws InputError  numbers overlap
    PositionView(const double* first, std::size_t count, std::size_t stride,
                 std::size_t step = sizeof(double))
        : TripleView(first, count, stride, step, "positions") {}
    PositionView(const float* first, std::size_t count, std::size_t stride, std::size_t step = sizeof(float))
        : TripleView(first, count, stride, step, "positions") {}
};

/// View of the caller's triangles, as triples or as a flat array of indices with 16 or 32 bits. Does not copy
/// or own them; they must outlive the view.
class TriangleView : public detail::TripleView<Index, Index, std::uint16_t> {
public:
    TriangleView() = default;
    /// Triples, or a flat array. Negative signed indices are out of range.
    /// \throws InputError  its length is no multiple of 3
    template <detail::TripleArray<Index, std::int32_t, std::uint16_t> Array>
    TriangleView(const Array& t)
        : TriangleView(detail::first_number(t), detail::triple_count(t, "triangles"),
                       3 * sizeof *detail::first_number(t)) {}

    /// Any layout, as for PositionView.
    /// \param first   first corner of the first triangle; need not be aligned
    /// \param count   number of triangles
    /// \param stride  bytes from one triangle to the next
    /// \param step    bytes from one corner to the next
    /// \throws InputError  indices overlap
    TriangleView(const Index* first, std::size_t count, std::size_t stride, std::size_t step = sizeof(Index))
        : TripleView(first, count, stride, step, "triangles") {}
    TriangleView(const std::int32_t* first, std::size_t count, std::size_t stride,
                 std::size_t step = sizeof(std::int32_t))
        : TripleView(first, count, stride, step, "triangles") {}
    TriangleView(const std::uint16_t* first, std::size_t count, std::size_t stride,
                 std::size_t step = sizeof(std::uint16_t))
        : TripleView(first, count, stride, step, "triangles") {}
};

/// Attributes of face corners, such as UVs and colours. Corners at one vertex with equal values form a wedge;
/// a vertex with several wedges is on a seam.
struct CornerAttributes {
    std::vector<float> values;  ///< 3 * faces * width, finite, in the order of the corners; or empty
    std::uint32_t width = 0;    ///< number of floats per corner; 0 if there are no attributes
};

/// View of the caller's triangle soup. Non-manifold edges, duplicate faces and faces of zero area are
/// allowed.
struct MeshView {
    PositionView positions;                   ///< one per vertex, model units, finite
    TriangleView triangles;                   ///< indices < positions.size()
    std::span<const Index> face_groups = {};  ///< empty, or the group (material) of each face
    /// Null, or attributes to preserve: collapses that would tear a seam are rejected.
    const CornerAttributes* attributes = nullptr;
    std::span<const std::uint8_t> vertex_locks = {};  ///< empty, or one per vertex; nonzero: must not move
    /// Empty, or one per vertex, in [1e-6, 1e6]: factor on the costs of its collapses, see docs/method.md.
    std::span<const float> vertex_weights = {};
};

/// A triangle mesh that owns its arrays.
struct TriangleMesh {
    std::vector<Vec3> positions;      ///< one per vertex, model units
    std::vector<Triangle> triangles;  ///< indices < positions.size()
    std::vector<Index> face_groups;   ///< empty, or one per face
    CornerAttributes attributes;      ///< empty, or 3 * faces corners

    /// View of this mesh; valid until the mesh is modified or destroyed.
    MeshView view() const {
        return {positions, triangles, face_groups, attributes.width ? &attributes : nullptr, {}};
    }
};

FAQEM_NAMESPACE_END
