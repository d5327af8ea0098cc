#pragma once
/// \file
/// JSON on stdout.

#include <nlohmann/json.hpp>

#include "faqem/compare.hpp"

namespace faqem::cli {

using Json = nlohmann::ordered_json;

/// The members of a MeshInfo, box as two points.
Json info_json(const MeshInfo& info);

/// File and material names need not be UTF-8: what is not is shown as U+FFFD.
void print_json(const Json& json);

/// On one line, and at once: whoever reads along need not wait.
void print_json_line(const Json& json);

}  // namespace faqem::cli
