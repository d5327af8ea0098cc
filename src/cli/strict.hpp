#pragma once
/// \file
/// --strict: what is otherwise repaired is an error.

#include <string>

#include "faqem/asset.hpp"

namespace faqem::cli {

/// Makes sure that nothing was repaired or left out when the asset was loaded, and that every face has an
/// area and is there once.
/// \param file  for messages
/// \throws InputError  naming the first of each
void require_clean(const Asset& asset, const std::string& file);

}  // namespace faqem::cli
