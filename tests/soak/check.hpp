#pragma once
/// \file
/// Checks of results that must pass for any input.

#include <string>

#include "faqem/simplify.hpp"

namespace faqem::soak {

/// Checks the result of simplifying `mesh` to the ratio `share`.
/// \return a description of the first fault; empty if there is none
std::string fault(const TriangleMesh& mesh, double share, const SimplifyResult& result);

/// Largest distance of a vertex of `result` from the bounding box of the referenced vertices of `mesh`,
/// relative to the diagonal of the box.
double outside_box(const TriangleMesh& mesh, const TriangleMesh& result);

}  // namespace faqem::soak
