#pragma once
/// \file
/// Options of bake_onto() as text.

#include <string_view>

#include "faqem/bake_onto.hpp"

namespace faqem::detail {

/// \param uvs           `auto`, `keep`, `new`, or empty
/// \param max_distance  as `0.1` or `2%`, or empty
/// \throws OptionError  a text has another form, or the distance is not above 0
FAQEM_EXPORT OntoOptions onto_options(std::string_view uvs, std::string_view max_distance);

}  // namespace faqem::detail
