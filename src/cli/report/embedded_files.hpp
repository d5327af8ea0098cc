#pragma once
/// \file
/// The files of this folder that the page is made of, as they were when faqem was built (embed.cmake).

#include <string_view>

namespace faqem::cli {

extern const std::string_view page_html, page_style, viewer_html;
extern const std::string_view viewer_script;  ///< viewer/, bundled; empty: built without npm

}  // namespace faqem::cli
