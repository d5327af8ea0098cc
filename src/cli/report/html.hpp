#pragma once
/// \file
/// Pieces of HTML.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace faqem::cli {

/// Text as HTML shows it, also inside of quoted attributes.
std::string escape_html(std::string_view text);

/// Replaces `@NAME@` by its value, each once and never inside of a value.
/// \param values  names in capitals, digits and underscores
/// \pre every name in the text has a value
std::string fill_template(std::string_view text,
                          const std::vector<std::pair<std::string_view, std::string>>& values);

/// A table. The first column and the row of titles are headers. All cells are text, to be escaped.
/// \param rows  as long as `titles` each
std::string html_table(const std::string& caption, const std::vector<std::string>& titles,
                       const std::vector<std::vector<std::string>>& rows);

}  // namespace faqem::cli
