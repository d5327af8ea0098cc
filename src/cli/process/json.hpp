#pragma once
/// \file
/// JSON as text.

#include <nlohmann/json.hpp>
#include <string>

#include "faqem/compare.hpp"

namespace faqem::cli {

using Json = nlohmann::ordered_json;

/// Returns the members of a MeshInfo as a JSON object with the keys documented in docs/reference.md.
Json info_json(const MeshInfo& info);

/// Returns indented JSON, with a line end. File and material names need not be UTF-8: invalid bytes become U+FFFD.
std::string json_text(const Json& json);

/// Returns JSON on one line, with its end. Invalid UTF-8 is replaced as by json_text().
std::string json_line(const Json& json);

}  // namespace faqem::cli
