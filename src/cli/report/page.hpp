#pragma once
/// \file
/// The page of `faqem report`: one HTML file that refers to no other.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/model_comparison.hpp"

namespace faqem::cli {

/// A column of the figures.
struct ReportedModel {
    std::string file;
    std::uint64_t bytes = 0;  ///< of the file and those that it refers to
    MeshInfo mesh;
    std::size_t materials = 0, images = 0;
};

struct Picture {
    Image png;
    std::string caption;      ///< for all, below it
    std::string description;  ///< instead of it, for those who do not see it
};

/// The models of the 3D view, and how it colours errors.
struct ViewerData {
    std::vector<std::uint8_t> a, b;  ///< from viewer_glb()
    double limit = 0,
           max_distance = 0;  ///< distance with the full colour, and the largest; in units of the frame
    double unit = 1;          ///< of the frame, model units
};

struct ReportPage {
    ReportedModel a, b;
    ModelComparison comparison;
    std::vector<Picture> pictures;
    std::optional<ViewerData> view;
    std::vector<std::string> notes;  ///< why there is no view, what was repaired; a sentence each
};

/// Whether faqem was built with the script of the 3D view.
bool has_viewer();

/// The page as HTML. Names of files are escaped; nothing is fetched when it is opened.
std::string report_html(const ReportPage& page);

}  // namespace faqem::cli
