#pragma once
/// \file
/// Converts a Target to a number of faces.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "faqem/export.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Smallest target of simplify(); lower targets are raised to it.
inline constexpr std::uint64_t min_target_faces = 4;

/// Number of faces that a target requests, at most 1e18. min_target_faces is not applied.
/// \param target  valid; Target::Kind::unset counts as a ratio
/// \param faces   number of faces of the mesh
inline std::uint64_t target_face_count(const Target& target, double faces) {
    // The factor prevents rounding errors from losing a face in floor(): 0.1 * 30 must give 3.
    const double wanted =
        target.kind == Target::Kind::faces ? target.value : target.value * faces * (1 + 1e-15);
    return static_cast<std::uint64_t>(std::floor(std::min(wanted, 1e18)));
}

}  // namespace detail
FAQEM_NAMESPACE_END
