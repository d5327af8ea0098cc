#pragma once
/// \file
/// Estimates of the memory that simplify() of a file needs: before the model is loaded, and before the work starts.

#include <cstdint>
#include <filesystem>
#include <limits>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Returns an upper estimate, in bytes, of the memory that estimated_model_memory() needs itself: for the JSON of glTF.
/// \param allowed  as there
FAQEM_EXPORT std::uint64_t estimated_document_memory(const std::filesystem::path& model,
                                                     std::uint64_t allowed);

/// Returns an upper estimate, in bytes, of the memory needed to load a model: from the file sizes, and from the
/// JSON of glTF, which tells the sizes of everything that will be decoded. Files that an OBJ file refers to are
/// not counted, because finding them takes as long as reading the file. 0 if the model is no regular file.
/// \param allowed  bytes; the estimate may end when it exceeds them
FAQEM_EXPORT std::uint64_t estimated_model_memory(
    const std::filesystem::path& model, std::uint64_t allowed = std::numeric_limits<std::uint64_t>::max());

/// Returns an upper estimate, in bytes, of the memory that simplify() needs besides that of the process with the loaded
/// model: histories, the simplification of the largest mesh, and decoded and baked images. The factors are measured, see
/// docs/measurements/stress.md.
/// Complexity: O(parts + images).
FAQEM_EXPORT std::uint64_t estimated_simplify_memory(const Asset& asset, const Options& options);

/// Returns an upper estimate, in bytes, of the memory of a run besides that for loading the model, before it is
/// loaded: as estimated_simplify_memory() for the largest number of faces that the files can have, and one texture. For
/// `faqem batch`, which decides by it how many models run at the same time.
/// \param model         only its extension is used
/// \param stored_bytes  total size of the model and the files it refers to
FAQEM_EXPORT std::uint64_t estimated_work_memory(const std::filesystem::path& model,
                                                 std::uint64_t stored_bytes, const Options& options);

}  // namespace faqem::detail
