#pragma once
/// \file
/// `--strict`: input that would otherwise be repaired is an error.

#include <string>

#include "faqem/asset.hpp"

namespace faqem::cli {

/// Checks that nothing was repaired or left out when the asset was loaded, that no positions differ by rounding
/// (find_rounding_weld()), and that it has no faces of zero area and no duplicate faces (same corners, winding and
/// material).
/// \param file  file name for the message
/// \throws InputError  a condition is violated; the message names the first such element
void require_clean(const Asset& asset, const std::string& file);

}  // namespace faqem::cli
