#pragma once
/// \file
/// The C door's levels.

#include <cstddef>
#include <vector>

#include "faqem/faqem_levels.h"
#include "faqem/levels.hpp"

namespace faqem::capi {

/// \throws OptionError  an enumerator or a number of faces that there is not
std::vector<Level> to_levels(const faqem_level* levels, std::size_t count);

}  // namespace faqem::capi
