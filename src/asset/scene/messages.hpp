#pragma once
/// \file
/// How messages name parts, materials and counts.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// `1 face`, `2 faces`.
FAQEM_EXPORT std::string pluralized(std::uint64_t count, const std::string& noun);

/// Adds a warning, `2 faces` and the rest of a sentence, unless the count is 0.
FAQEM_EXPORT void add_counted(std::vector<std::string>& warnings, std::uint64_t count,
                              const std::string& noun, const std::string& rest);

/// `12 bytes`.
std::string bytes_text(std::uint64_t count);

/// How often each kind of statement was ignored, by its name in the form of a message.
using IgnoredStatements = std::map<std::string, std::uint64_t>;

/// `'Ks': 2 statements` for each kind, in the order of the names: entries of Asset::not_understood.
std::vector<std::string> ignored_messages(const IgnoredStatements& ignored);

/// `material 'red'`, or `material 3` if it has no name.
FAQEM_EXPORT std::string material_title(const Asset& asset, Index material);

/// `part 'leg'`, or `part 3` if it has no name.
FAQEM_EXPORT std::string part_title(const Asset& asset, std::size_t part);

}  // namespace faqem::detail
