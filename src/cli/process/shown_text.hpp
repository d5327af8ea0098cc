#pragma once
/// \file
/// Values as text for people.

#include <cstdint>
#include <string>

namespace faqem::cli {

/// `812 bytes`, `1.2 kB`, `34.5 MB`.
std::string shown_bytes(std::uint64_t bytes);

}  // namespace faqem::cli
