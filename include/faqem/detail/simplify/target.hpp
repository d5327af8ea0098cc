#pragma once
/// \file
/// From a Target to a number of faces.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "faqem/export.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// What simplify() takes any lower target for.
inline constexpr std::uint64_t min_target_faces = 4;

/// The faces that a target asks for of a mesh with `faces` of them, before min_target_faces. At most 1e18.
/// \pre the target is valid
inline std::uint64_t target_face_count(const Target& target, double faces) {
    // floor() of a share may not lose a face to rounding: 0.1 * 30 is 3.
    const double wanted =
        target.kind == Target::Kind::faces ? target.value : target.value * faces * (1 + 1e-15);
    return static_cast<std::uint64_t>(std::floor(std::min(wanted, 1e18)));
}

}  // namespace detail
FAQEM_NAMESPACE_END
