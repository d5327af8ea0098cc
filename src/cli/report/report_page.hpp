#pragma once
/// \file
/// The page of `faqem report`: a self-contained HTML file.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/model_comparison.hpp"

namespace faqem::cli {

struct Picture {
    Image webp;
    std::string caption;      ///< text below the picture
    std::string description;  ///< alternative text
};

/// The models of the 3D view and the scale of its heat map.
struct ViewerData {
    std::vector<std::uint8_t> a, b;  ///< GLB files from viewer_glb()
    double limit = 0;                ///< distance at the end of the colour scale, units of the frame
    double max_distance = 0;         ///< maximum distance, units of the frame
    double unit = 1;                 ///< ViewerFrame::unit, model units
    std::string up = "y";            ///< axis
};

struct ReportPage {
    const FlattenedModel &a, &b;
    ModelComparison comparison;
    std::vector<Picture> pictures;
    std::optional<ViewerData> view;
    std::vector<std::string> notes;  ///< sentences: reason for a missing view, warnings of load()
};

/// Returns whether faqem was built with the script of the 3D view.
bool has_viewer();

/// Returns the page as HTML. File names are escaped. The page loads no external resources.
std::string report_html(const ReportPage& page);

}  // namespace faqem::cli
