#pragma once
/// \file
/// Estimate of the memory for the JSON of a glTF file: each number of one byte becomes an object.

#include <cstdint>
#include <filesystem>

namespace faqem::cli {

/// Returns an upper estimate, in bytes, of the memory for the JSON of a glTF file while it is loaded and
/// saved, from the numbers of its values. Needs no memory itself.
/// \param model    a regular file. Of a file that is damaged or no glTF, the part before the error is counted
/// \param allowed  bytes; the estimate ends when it exceeds them
std::uint64_t estimated_json_memory(const std::filesystem::path& model, std::uint64_t allowed);

}  // namespace faqem::cli
