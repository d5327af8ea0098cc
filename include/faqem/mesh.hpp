#pragma once
/// \file
/// Triangle meshes as plain arrays: views of the caller's arrays for input, and meshes that own their arrays.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

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

/// View of the caller's vertex positions, float or double: packed, interleaved with other data, or
/// column-major. Does not copy or own them; they must outlive the view.
class PositionView {
public:
    PositionView() = default;
    PositionView(std::span<const Vec3> p) : PositionView(scalars(p), p.size(), sizeof(Vec3)) {}
    PositionView(std::span<const Vec3f> p) : PositionView(scalars(p), p.size(), sizeof(Vec3f)) {}
    PositionView(const std::vector<Vec3>& p) : PositionView(scalars(p), p.size(), sizeof(Vec3)) {}
    PositionView(const std::vector<Vec3f>& p) : PositionView(scalars(p), p.size(), sizeof(Vec3f)) {}
    /// Flat array x0 y0 z0 x1 ...; one or two excess numbers at the end are ignored.
    PositionView(std::span<const double> xyz) : PositionView(xyz.data(), xyz.size() / 3, sizeof(Vec3)) {}
    PositionView(std::span<const float> xyz) : PositionView(xyz.data(), xyz.size() / 3, sizeof(Vec3f)) {}
    PositionView(const std::vector<double>& xyz) : PositionView(xyz.data(), xyz.size() / 3, sizeof(Vec3)) {}
    PositionView(const std::vector<float>& xyz) : PositionView(xyz.data(), xyz.size() / 3, sizeof(Vec3f)) {}

    /// Any layout. For an array of structs Vertex the stride is sizeof(Vertex). For a column-major matrix
    /// with one row per vertex the stride is sizeof(double), and the step sizeof(double) * rows.
    /// \param first   x of the first vertex; need not be aligned
    /// \param count   number of vertices
    /// \param stride  bytes from one vertex to the next
    /// \param step    bytes from x to y, and from y to z
    PositionView(const double* first, std::size_t count, std::size_t stride,
                 std::size_t step = sizeof(double))
        : data_(first), size_(count), stride_(stride), step_(step), is_double_(true) {}
    PositionView(const float* first, std::size_t count, std::size_t stride, std::size_t step = sizeof(float))
        : data_(first), size_(count), stride_(stride), step_(step) {}

    /// Number of vertices.
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }

    Vec3 operator[](std::size_t i) const {
        const auto* at = static_cast<const std::byte*>(data_) + i * stride_;
        if (is_double_) return {read<double>(at), read<double>(at + step_), read<double>(at + 2 * step_)};
        return {read<float>(at), read<float>(at + step_), read<float>(at + 2 * step_)};
    }

private:
    template <class Vecs>
    static const typename Vecs::value_type::value_type* scalars(const Vecs& p) {
        return p.empty() ? nullptr : p.data()->data();
    }

    template <class Scalar>
    static double read(const std::byte* at) {
        Scalar value;
        std::memcpy(&value, at, sizeof value);  // NOLINT(clang-analyzer-core.NonNullParamChecker): i < size()
        return value;
    }

    const void* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t stride_ = 0, step_ = 0;  // bytes
    bool is_double_ = false;
};

/// View of the caller's triangles, as triples or as a flat array of indices with 16 or 32 bits. Does not copy
/// or own them; they must outlive the view.
class TriangleView {
public:
    TriangleView() = default;
    TriangleView(std::span<const Triangle> t)
        : TriangleView(t.empty() ? nullptr : t.front().data(), t.size(), sizeof(Triangle)) {}
    TriangleView(const std::vector<Triangle>& t)
        : TriangleView(t.empty() ? nullptr : t.front().data(), t.size(), sizeof(Triangle)) {}
    /// Flat array, three indices per triangle; one or two excess indices at the end are ignored.
    TriangleView(std::span<const Index> flat)
        : TriangleView(flat.data(), flat.size() / 3, sizeof(Triangle)) {}
    TriangleView(std::span<const std::uint16_t> flat)
        : TriangleView(flat.data(), flat.size() / 3, 3 * sizeof(std::uint16_t)) {}
    TriangleView(const std::vector<Index>& flat)
        : TriangleView(flat.data(), flat.size() / 3, sizeof(Triangle)) {}
    TriangleView(const std::vector<std::uint16_t>& flat)
        : TriangleView(flat.data(), flat.size() / 3, 3 * sizeof(std::uint16_t)) {}

    /// Any layout, as for PositionView. Negative signed indices are out of range.
    /// \param first   first corner of the first triangle; need not be aligned
    /// \param count   number of triangles
    /// \param stride  bytes from one triangle to the next
    /// \param step    bytes from one corner to the next
    TriangleView(const Index* first, std::size_t count, std::size_t stride, std::size_t step = sizeof(Index))
        : data_(first), size_(count), stride_(stride), step_(step) {}
    TriangleView(const std::int32_t* first, std::size_t count, std::size_t stride,
                 std::size_t step = sizeof(std::int32_t))
        : data_(first), size_(count), stride_(stride), step_(step) {}
    TriangleView(const std::uint16_t* first, std::size_t count, std::size_t stride,
                 std::size_t step = sizeof(std::uint16_t))
        : data_(first), size_(count), stride_(stride), step_(step), is_short_(true) {}

    /// Number of triangles.
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }

    Triangle operator[](std::size_t f) const {
        const auto* at = static_cast<const std::byte*>(data_) + f * stride_;
        if (is_short_)
            return {read<std::uint16_t>(at), read<std::uint16_t>(at + step_),
                    read<std::uint16_t>(at + 2 * step_)};
        return {read<Index>(at), read<Index>(at + step_), read<Index>(at + 2 * step_)};
    }

private:
    template <class Number>
    static Index read(const std::byte* at) {
        Number value;
        std::memcpy(&value, at, sizeof value);
        return value;
    }

    const void* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t stride_ = 0, step_ = 0;  // bytes
    bool is_short_ = false;
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
