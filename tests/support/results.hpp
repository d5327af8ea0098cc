#pragma once
/// \file
/// Counters, bit patterns and files of the results of simplify().

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "faqem/history.hpp"
#include "faqem/mesh.hpp"
#include "faqem/report.hpp"

namespace faqem::test {

/// How often a rung of the starvation ladder was taken.
inline std::uint64_t taken(const Report& report, Rung rung) {
    return report.rungs[static_cast<std::size_t>(rung)];
}

/// How many collapses were refused for a reason.
inline std::uint64_t refused(const Report& report, Refusal why) {
    return report.refusals[static_cast<std::size_t>(why)];
}

/// Whether two arrays are equal bit for bit. Unlike ==, this distinguishes 0 and -0.
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool same_bits(const TriangleMesh& a, const TriangleMesh& b) {
    return same_bits(a.positions, b.positions) && same_bits(a.triangles, b.triangles) &&
           same_bits(a.face_groups, b.face_groups) && same_bits(a.attributes.values, b.attributes.values) &&
           a.attributes.width == b.attributes.width;
}

/// The bytes that write() makes of a CollapseHistory or a ChainHistory.
template <class History>
std::string file_bytes(const History& history) {
    std::ostringstream out;
    write(history, out);
    return out.str();
}

}  // namespace faqem::test
