#pragma once
/// \file
/// Loading of a model; `--strict`: input that would otherwise be repaired is an error.

#include <filesystem>

#include "faqem/asset.hpp"

namespace faqem::cli {

/// Whether input that load() repairs or leaves out is an error.
enum class Strictness { lenient, strict };

/// With Strictness::strict, checks that nothing was repaired or left out when the asset was loaded, that no positions
/// differ by rounding (find_rounding_weld()), and that it has no faces of zero area and no duplicate faces (same
/// corners, winding and material).
/// \param file  name for the message
/// \throws InputError  a condition is violated; the message names the first such element
void check_strictness(const Asset& asset, const std::filesystem::path& file, Strictness strictness);

/// Loads a model that has triangles, and checks it.
/// \throws whatever detail::load_triangles() and check_strictness() throw
Asset load_model(const std::filesystem::path& file, Strictness strictness);

}  // namespace faqem::cli
