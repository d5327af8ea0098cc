#pragma once
/// \file
/// What must be so of a result, whatever came in.

#include <string>

#include "faqem/simplify.hpp"

namespace faqem::soak {

/// \return what is wrong with the result of simplifying `mesh` to `share`, empty if nothing is
std::string fault(const TriangleMesh& mesh, double share, const SimplifyResult& result);

/// How far the farthest vertex of `result` is outside the box of the used vertices of `mesh`, in diagonals of
/// the box.
double outside_box(const TriangleMesh& mesh, const TriangleMesh& result);

}  // namespace faqem::soak
