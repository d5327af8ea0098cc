#pragma once
/// \file
/// Conversion of the C API's levels.

#include <cstddef>
#include <vector>

#include "faqem/faqem_levels.h"
#include "faqem/levels.hpp"

namespace faqem::capi {

/// Converts levels of the C API.
/// \throws OptionError  a kind is unknown, or a number of faces is not an integer from 1 to 2^53
std::vector<Level> to_levels(const faqem_level* levels, std::size_t count);

}  // namespace faqem::capi
