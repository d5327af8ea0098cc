#pragma once
/// \file
/// Functions that generate HTML, and Base64 for embedded data.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace faqem::cli {

/// Escapes text for HTML, also inside quoted attributes.
std::string escape_html(std::string_view text);

/// The same, with places after slashes where long names may be broken; not for attributes.
std::string breakable_html(std::string_view text);

/// Replaces each `@@NAME@@` in a text by its value. Names inside values are not replaced.
/// \param values  pairs of name and value
/// \pre every name in the text has a value
std::string fill_template(std::string_view text,
                          const std::vector<std::pair<std::string_view, std::string>>& values);

/// Returns an HTML table. The row of titles and the first column are header cells. All texts are escaped.
/// \param rows  each with as many cells as `titles`
std::string html_table(const std::string& caption, const std::vector<std::string>& titles,
                       const std::vector<std::vector<std::string>>& rows);

/// Returns the Base64 encoding of bytes, with padding (RFC 4648, section 4).
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace faqem::cli
