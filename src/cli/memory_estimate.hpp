#pragma once
/// \file
/// Estimates of the memory that `faqem simplify` needs, made before the work starts. `faqem batch` uses
/// batch/memory_semaphore.hpp instead, which needs the file sizes only.

#include <cstdint>
#include <filesystem>

#include "faqem/asset.hpp"
#include "faqem/error.hpp"
#include "faqem/options.hpp"

namespace faqem::cli {

/// Thrown if the estimated memory exceeds the limit. The command exits with code 11.
class MemoryError : public Error {
public:
    using Error::Error;
};

/// Returns an upper estimate, in bytes, of the memory needed to load a model, from the file sizes alone.
/// Compressed glTF may need more, because its decoded size is known only after reading. Files that an OBJ
/// file refers to are not counted, because finding them takes as long as reading the file.
std::uint64_t estimated_loading_memory(const std::filesystem::path& model);

/// Returns an upper estimate, in bytes, of the peak memory of the whole run: the process, the model, its
/// history, the simplification of the largest mesh, and decoded and baked images. The factors are measured,
/// see docs/robustness.md. Complexity: O(parts + images).
std::uint64_t estimated_peak_memory(const Asset& asset, const Options& options);

/// Checks an estimate against the limit.
/// \param file             file name for the message
/// \param needed, allowed  bytes
/// \throws MemoryError  `needed` exceeds `allowed`; the message has the file name and both numbers
void require_memory(const std::filesystem::path& file, std::uint64_t needed, std::uint64_t allowed);

}  // namespace faqem::cli
