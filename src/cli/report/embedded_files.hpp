#pragma once
/// \file
/// The files of this directory from which the page is composed, embedded at build time (embed.cmake).

#include <string_view>

namespace faqem::cli {

extern const std::string_view page_html, page_style, viewer_html;
extern const std::string_view viewer_script;  ///< bundle of viewer/; empty if faqem was built without npm

}  // namespace faqem::cli
