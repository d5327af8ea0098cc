#pragma once
/// \file
/// Printing of JSON to stdout.

#include <nlohmann/json.hpp>

#include "faqem/compare.hpp"

namespace faqem::cli {

using Json = nlohmann::ordered_json;

/// Returns the members of a MeshInfo as a JSON object with the keys documented in docs/cli.md.
Json info_json(const MeshInfo& info);

/// Prints indented JSON. File and material names need not be UTF-8: invalid bytes are printed as U+FFFD.
void print_json(const Json& json);

/// Prints JSON on one line and flushes stdout, so that a reader of a pipe gets each line immediately.
void print_json_line(const Json& json);

}  // namespace faqem::cli
