#pragma once
/// \file
/// Triangle meshes as plain arrays: what goes into faqem and what comes out.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace faqem {

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

/// Positions that belong to the caller, as float or double, tightly packed xyz.
class PositionView {
public:
    PositionView() = default;
    PositionView(std::span<const Vec3> p) : data_(p.data()), size_(p.size()), is_double_(true) {}
    PositionView(std::span<const Vec3f> p) : data_(p.data()), size_(p.size()) {}
    PositionView(const std::vector<Vec3>& p) : PositionView(std::span(p)) {}
    PositionView(const std::vector<Vec3f>& p) : PositionView(std::span(p)) {}
    /// Flat xyz; a trailing one or two numbers are ignored.
    PositionView(std::span<const double> xyz) : data_(xyz.data()), size_(xyz.size() / 3), is_double_(true) {}
    PositionView(std::span<const float> xyz) : data_(xyz.data()), size_(xyz.size() / 3) {}
    PositionView(const std::vector<double>& xyz) : PositionView(std::span(xyz)) {}
    PositionView(const std::vector<float>& xyz) : PositionView(std::span(xyz)) {}

    /// Number of vertices.
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }

    Vec3 operator[](std::size_t i) const {
        if (is_double_) {
            const double* p = static_cast<const double*>(data_) + 3 * i;
            return {p[0], p[1], p[2]};
        }
        const float* p = static_cast<const float*>(data_) + 3 * i;
        return {p[0], p[1], p[2]};
    }

private:
    const void* data_ = nullptr;
    std::size_t size_ = 0;
    bool is_double_ = false;
};

/// Triangles that belong to the caller, as triples or as a flat list of indices.
class TriangleView {
public:
    TriangleView() = default;
    TriangleView(std::span<const Triangle> t)
        : data_(t.empty() ? nullptr : t.front().data()), size_(t.size()) {}
    TriangleView(const std::vector<Triangle>& t) : TriangleView(std::span(t)) {}
    /// Flat list; a trailing one or two indices are ignored.
    TriangleView(std::span<const Index> flat) : data_(flat.data()), size_(flat.size() / 3) {}
    TriangleView(const std::vector<Index>& flat) : TriangleView(std::span(flat)) {}

    /// Number of triangles.
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Triangle operator[](std::size_t f) const { return {data_[3 * f], data_[3 * f + 1], data_[3 * f + 2]}; }

private:
    const Index* data_ = nullptr;
    std::size_t size_ = 0;
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

}  // namespace faqem
