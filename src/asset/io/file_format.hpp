#pragma once
/// \file
/// Detection of the format of a model file.

#include <filesystem>
#include <string>

#include "faqem/export.hpp"

namespace faqem::detail {

/// Formats of model files; `gltf` is both .glb and .gltf.
enum class Format { unknown, gltf, obj, ply, stl, off };

/// Returns the extension of a file name with its dot, in lower case (ASCII).
FAQEM_EXPORT std::string lower_case_extension(const std::filesystem::path& file);

/// Returns the format by the extension of the name, which determines the format of an output file.
FAQEM_EXPORT Format format_by_name(const std::filesystem::path& file);

/// Returns the format of an existing file: by its first bytes, or by its name if these have no signature.
/// \param file  a regular file; one that cannot be read has the format of its name
FAQEM_EXPORT Format format_of_file(const std::filesystem::path& file);

}  // namespace faqem::detail
