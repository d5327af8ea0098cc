#pragma once
/// \file
/// Repair of non-finite values and checks of element counts, common to all formats.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

/// Maximum number of vertices, and of faces, of a part.
inline constexpr std::uint64_t max_index_count = no_index;

/// Whether no coordinate is infinite or NaN.
template <class T, std::size_t N>
bool is_finite(const std::array<T, N>& v) {
    return std::ranges::all_of(v, [](T x) { return std::isfinite(x); });
}

/// Checks a number of vertices or faces.
/// \param file     path for messages
/// \param element  the kind of element for messages, e.g. `vertex`
/// \throws InputError  if `count` exceeds max_index_count
inline void check_index_count(std::uint64_t count, const std::string& file, const std::string& element) {
    if (count > max_index_count)
        throw InputError(file, element,
                         "there are " + std::to_string(count) + ", more than the " +
                             std::to_string(max_index_count) + " that 32-bit indices can address");
}

/// Replaces vectors that are not finite. Returns their number.
template <class T, std::size_t N>
std::uint64_t reset_non_finite(std::vector<std::array<T, N>>& values, const std::array<T, N>& neutral) {
    std::uint64_t count = 0;
    for (std::array<T, N>& value : values)
        if (!is_finite(value)) value = neutral, ++count;
    return count;
}

/// Removes vertices with non-finite positions and their adjacent faces, and resets other non-finite values: colours to
/// white, others to zero. Adds one warning with a count for each kind of repair.
/// \param dropped   number of faces that the reader has already left out for the same reason
/// \param warnings  receives the warnings
/// \return the number of faces that were left out
std::uint64_t repair_vertices(Part& part, std::uint64_t dropped, std::vector<std::string>& warnings);

/// Same as above, for the only part of a file.
/// \param file  path for messages
/// \throws InputError  if no faces are left
void repair_non_finite(Part& part, const std::string& file, std::uint64_t dropped,
                       std::vector<std::string>& warnings);

}  // namespace faqem::detail
