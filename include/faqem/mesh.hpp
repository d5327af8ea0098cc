#pragma once
/// \file
/// Triangle meshes as plain arrays: what goes into faqem and what comes out.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN

/// Index of a vertex, face or corner. Corner c of face f is 3 * f + c, always computed in 64 bits.
using Index = std::uint32_t;

/// "None", wherever an Index may be absent.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

using Vec2f = std::array<float, 2>;
using Vec3f = std::array<float, 3>;
using Vec4f = std::array<float, 4>;
using Vec3 = std::array<double, 3>;

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<Index, 3>;

/// Positions that belong to the caller, as float or double, where they are: packed, interleaved with other
/// data, or one coordinate after the other. Nothing is copied.
class PositionView {
public:
    PositionView() = default;
    PositionView(std::span<const Vec3> p) : PositionView(scalars(p), p.size(), sizeof(Vec3)) {}
    PositionView(std::span<const Vec3f> p) : PositionView(scalars(p), p.size(), sizeof(Vec3f)) {}
    PositionView(const std::vector<Vec3>& p) : PositionView(scalars(p), p.size(), sizeof(Vec3)) {}
    PositionView(const std::vector<Vec3f>& p) : PositionView(scalars(p), p.size(), sizeof(Vec3f)) {}
    /// Flat xyz; a trailing one or two numbers are ignored.
    PositionView(std::span<const double> xyz) : PositionView(xyz.data(), xyz.size() / 3, sizeof(Vec3)) {}
    PositionView(std::span<const float> xyz) : PositionView(xyz.data(), xyz.size() / 3, sizeof(Vec3f)) {}
    PositionView(const std::vector<double>& xyz) : PositionView(xyz.data(), xyz.size() / 3, sizeof(Vec3)) {}
    PositionView(const std::vector<float>& xyz) : PositionView(xyz.data(), xyz.size() / 3, sizeof(Vec3f)) {}

    /// Any layout: sizeof(Vertex) is the stride of positions in an array of Vertex; of a matrix with a row
    /// per vertex, column by column, it is sizeof(double), and the step sizeof(double) * rows.
    /// \param first   x of the first vertex; need not be aligned
    /// \param count   of vertices
    /// \param stride  bytes from a vertex to the next one
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

/// Triangles that belong to the caller, as triples or as a flat list of indices, of 16 or 32 bits. Nothing is
/// copied.
class TriangleView {
public:
    TriangleView() = default;
    TriangleView(std::span<const Triangle> t)
        : TriangleView(t.empty() ? nullptr : t.front().data(), t.size(), sizeof(Triangle)) {}
    TriangleView(const std::vector<Triangle>& t)
        : TriangleView(t.empty() ? nullptr : t.front().data(), t.size(), sizeof(Triangle)) {}
    /// Flat list; a trailing one or two indices are ignored.
    TriangleView(std::span<const Index> flat)
        : TriangleView(flat.data(), flat.size() / 3, sizeof(Triangle)) {}
    TriangleView(std::span<const std::uint16_t> flat)
        : TriangleView(flat.data(), flat.size() / 3, 3 * sizeof(std::uint16_t)) {}
    TriangleView(const std::vector<Index>& flat)
        : TriangleView(flat.data(), flat.size() / 3, sizeof(Triangle)) {}
    TriangleView(const std::vector<std::uint16_t>& flat)
        : TriangleView(flat.data(), flat.size() / 3, 3 * sizeof(std::uint16_t)) {}

    /// Any layout, as PositionView(). Of signed indices, those below 0 are out of range.
    /// \param first   first corner of the first triangle; need not be aligned
    /// \param count   of triangles
    /// \param stride  bytes from a triangle to the next one
    /// \param step    bytes from a corner to the next one
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

/// Attributes that live on face corners (UVs, colours): `width` floats per corner, 3 * faces corners.
/// Corners at one vertex with equal values form a wedge; a vertex with more than one wedge is on a seam.
struct CornerAttributes {
    std::vector<float> values;  ///< 3 * faces * width, or empty
    std::uint32_t width = 0;    ///< floats per corner; 0 when there are none
};

/// A triangle soup that belongs to the caller. Non-manifold edges, duplicate and zero-area faces are allowed.
struct MeshView {
    PositionView positions;                        ///< one per vertex, model units, finite
    TriangleView triangles;                        ///< each index < positions.size()
    std::span<const Index> face_groups = {};       ///< empty, or one group (material) per face
    const CornerAttributes* attributes = nullptr;  ///< null, or attributes to carry along (UVs are kept)
    std::span<const std::uint8_t> vertex_locks =
        {};  ///< empty, or one per vertex; nonzero: must stay where it is
    /// Empty, or one per vertex, in [1e-6, 1e6]: errors around it count this many times. See docs/method.md.
    std::span<const float> vertex_weights = {};
};

/// A triangle mesh that owns its arrays.
struct TriangleMesh {
    std::vector<Vec3> positions;      ///< one per vertex, model units
    std::vector<Triangle> triangles;  ///< each index < positions.size()
    std::vector<Index> face_groups;   ///< empty, or one per face
    CornerAttributes attributes;      ///< empty, or 3 * faces corners

    MeshView view() const {
        return {positions, triangles, face_groups, attributes.width ? &attributes : nullptr, {}};
    }
};

FAQEM_NAMESPACE_END
