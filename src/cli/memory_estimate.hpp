#pragma once
/// \file
/// How much memory simplify takes, told before it does.

#include <cstdint>
#include <filesystem>

#include "faqem/asset.hpp"
#include "faqem/error.hpp"
#include "faqem/options.hpp"

namespace faqem::cli {

/// The work would take more memory than is allowed.
class MemoryError : public Error {
public:
    using Error::Error;
};

/// An upper estimate of what loading takes, from the sizes of the files alone, bytes. Compressed glTF may
/// take more: what it holds is only known when it is read. What an OBJ refers to is not counted: finding that
/// takes as long as reading it.
std::uint64_t estimated_loading_memory(const std::filesystem::path& model);

/// An upper estimate of what the whole run takes at its peak, bytes: the process, the model, its history, the
/// work on the largest mesh, and what baking decodes and makes. By what was measured, see docs/robustness.md.
/// O(parts + images)
std::uint64_t estimated_peak_memory(const Asset& asset, const Options& options);

/// \param needed, allowed  bytes
/// \throws MemoryError  more is needed than allowed: with the name of the file and both numbers
void require_memory(const std::filesystem::path& file, std::uint64_t needed, std::uint64_t allowed);

}  // namespace faqem::cli
