#pragma once
/// \file
/// An upper bound of the distance of a triangle from a surface of many faces: the faces above and below it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "faqem/detail/geometry/surface.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A surface with the faces at each edge, to cover triangles with its faces.
///
/// A set of faces is grown from one face until each edge above the triangle (along its normal, on either side) belongs to
/// an even number of them. The number of faces of the set above a point, modulo 2, is then the same for all points of the
/// triangle in general position. If it is odd at one of them, a face lies above every point, and the largest height of the
/// faces above the triangle is an upper bound of its distance. Two rims that coincide would be undecidable; therefore the
/// triangle is first shrunk by an eighth of the limit, which the bound includes.
///
/// Immutable; const functions may be called by several threads.
class Covering {
public:
    /// \param surface  not empty; must outlive this object
    /// O(n log n) time, 50 bytes per face
    explicit Covering(const Surface& surface);

    /// Memory of the searches of one thread.
    class Scratch {
    public:
        explicit Scratch(const Covering& covering) : is_in_set_(covering.triangles_.size(), 0) {}

    private:
        friend class Covering;
        std::vector<std::uint8_t> is_in_set_;  // all 0 between searches
        std::vector<Index> set_;
    };

    /// An upper bound of the distance from a triangle to the surface, model units, up to rounding.
    /// \param corner  of the triangle
    /// \param first   a face near its middle
    /// \param limit   largest bound that is of interest
    /// \return infinity if no bound up to the limit was found
    /// O(faces above the triangle)
    double bound(const std::array<engine::Vector3, 3>& corner, Index first, double limit,
                 Scratch& scratch) const;

private:
    struct Prism;
    struct Edge {
        Index begin, count;
    };

    double grow(const Prism& prism, Index first, double limit, Scratch& scratch) const;
    bool covers(const Prism& prism, const std::vector<Index>& set) const;
    std::array<engine::Vector3, 3> projected(const Prism& prism, Index f) const;

    const Surface& surface_;
    std::vector<Triangle> triangles_;  // of the surface, then the slivers
    std::vector<Edge> edges_;          // three per triangle: its range in faces_
    std::vector<Index> faces_;         // by edge
    double size_ = 0;                  // largest coordinate
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/measure/covering-inl.hpp"
#endif
