#pragma once
/// \file
/// The page of `faqem report`: a self-contained HTML file.

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/process/json.hpp"
#include "cli/process/shown_text.hpp"
#include "cli/report/embedded_files.hpp"
#include "cli/report/error_surface.hpp"
#include "cli/report/html.hpp"
#include "cli/report/model_comparison.hpp"
#include "faqem/version.hpp"
#include "render/views.hpp"

namespace faqem::cli {

struct Picture {
    Image webp;
    std::string caption;      ///< text below the picture
    std::string description;  ///< alternative text
};

/// The models of the 3D view and the scale of its heat map.
struct ViewerData {
    std::vector<std::uint8_t> a, b;  ///< GLB files from viewer_glb()
    /// `limit`, the distance at the end of the colour scale, and `max_distance`, both in units of the frame; `unit`, of the
    /// frame in model units; `up`, an axis; `ramp`, heat_ramp.
    Json scale;
};

struct ReportPage {
    const FlattenedModel &a, &b;
    ModelComparison comparison;
    std::vector<Picture> pictures;
    std::optional<ViewerData> view;
    std::vector<std::string> notes;  ///< sentences: reason for a missing view, warnings of load()
};

inline std::string name_of(const FlattenedModel& model) {
    return std::filesystem::path(model.file).filename().string();
}

inline std::string counts_table(const FlattenedModel& a, const FlattenedModel& b) {
    const auto row = [](const char* what, std::uint64_t of_a, std::uint64_t of_b,
                        std::string (*shown)(std::uint64_t) = render::with_commas) {
        return std::vector<std::string>{
            what, shown(of_a), shown(of_b),
            of_a > 0 ? shown_percent(static_cast<double>(of_b) / static_cast<double>(of_a)) : "–"};
    };
    return html_table(
        "Counts, after welding positions that are equal or differ by rounding",
        {"", name_of(a), name_of(b), "ratio"},
        {row("Faces", a.info.faces, b.info.faces), row("Vertices", a.info.vertices, b.info.vertices),
         row("Components (connected pieces)", a.info.components, b.info.components),
         row("Boundary edges (of one face)", a.info.boundary_edges, b.info.boundary_edges),
         row("Non-manifold edges (of three or more faces)", a.info.nonmanifold_edges,
             b.info.nonmanifold_edges),
         row("Materials", a.asset.materials.size(), b.asset.materials.size()),
         row("Images", a.asset.images.size(), b.asset.images.size()),
         row("Bytes", a.asset.file_bytes, b.asset.file_bytes, shown_bytes)});
}

/// A row of a table of both directions.
inline auto row_of(const auto& compared) {
    return [&](const char* what, auto&& value) {
        return std::vector<std::string>{what, value(compared.a_to_b), value(compared.b_to_a)};
    };
}

inline std::string distances_table(const ReportPage& page) {
    const Comparison& c = page.comparison.distances;
    const auto row = row_of(c);
    const auto cell = [&](double distance) {
        return shown_number(distance) + " (" + shown_percent(distance / c.diagonal) + ")";
    };
    return html_table("Distances, in model units and relative to the diagonal of " + name_of(page.a),
                      {"", "to " + name_of(page.b), "to " + name_of(page.a)},
                      {row("Maximum, at least", [&](const OneSided& s) { return cell(s.max); }),
                       row("Maximum, at most", [&](const OneSided& s) { return cell(s.max_bound); }),
                       row("Mean", [&](const OneSided& s) { return cell(s.mean); }),
                       row("Root mean square (large distances count more)",
                           [&](const OneSided& s) { return cell(std::sqrt(s.mean_squared)); }),
                       row("Mean angle between the normals",
                           [](const OneSided& s) { return shown_number(s.mean_normal_degrees, 3) + "°"; })});
}

inline std::string colors_table(const ReportPage& page) {
    if (!page.comparison.colors) return {};
    const ColorComparison& c = *page.comparison.colors;
    const auto row = row_of(c);
    const std::string decibels = std::isfinite(c.psnr) ? shown_number(c.psnr) + " dB" : "no difference";
    return html_table(
        "Colour differences without light, from 0 to 1; PSNR, which is higher for smaller ones: " + decibels,
        {"", "to " + name_of(page.b), "to " + name_of(page.a)},
        {row("Root mean square", [](const OneSidedColors& s) { return shown_number(s.rmse, 3); }),
         row("Share of the surface with more than 0.25",
             [](const OneSidedColors& s) { return shown_percent(s.outliers); }),
         row("Share without a face of similar orientation",
             [](const OneSidedColors& s) { return shown_percent(s.unmatched); }),
         row("Share cut away by transparency",
             [](const OneSidedColors& s) { return shown_percent(s.hidden); })});
}

inline std::string pictures(const ReportPage& page) {
    std::string html;
    for (const Picture& picture : page.pictures) {
        html += "<figure><img alt=\"" + escape_html(picture.description) +
                "\" src=\"data:image/webp;base64," + base64(picture.webp.encoded) + "\"><figcaption>" +
                escape_html(picture.caption) + "</figcaption></figure>\n";
    }
    return html;
}

inline std::string notes(const ReportPage& page) {
    std::string html;
    for (const std::string& note : page.notes) html += "<p class=\"note\">" + breakable_html(note) + "</p>\n";
    return html;
}

inline std::string caption(const FlattenedModel& model) {
    return escape_html(name_of(model)) + ", " + render::with_commas(model.info.faces) + " faces";
}

inline std::string view(const ReportPage& page) {
    if (!page.view) return {};
    return fill_template(viewer_html, {{"CAPTION_A", caption(page.a)}, {"CAPTION_B", caption(page.b)}});
}

inline std::string scripts(const ReportPage& page) {
    if (!page.view) return {};
    const auto block = [](const char* id, const char* type, std::string_view text) {
        return std::string("<script id=\"") + id + "\" type=\"" + type + "\">" + std::string(text) +
               "</script>\n";
    };
    const ViewerData& v = *page.view;
    return block("view-data", "application/json", v.scale.dump()) +
           block("model-a", "application/octet-stream", base64(v.a)) +
           block("model-b", "application/octet-stream", base64(v.b)) + "<script>" +
           std::string(viewer_script) + "</script>\n";
}

inline std::string ramp_stops() {
    std::string stops;
    for (const auto& color : heat_ramp)
        stops += (stops.empty() ? "rgb(" : ", rgb(") + std::to_string(color[0]) + " " +
                 std::to_string(color[1]) + " " + std::to_string(color[2]) + ")";
    return stops;
}

/// Returns whether faqem was built with the script of the 3D view.
inline bool has_viewer() { return !viewer_script.empty(); }

/// Returns the page as HTML. File names are escaped. The page loads no external resources.
inline std::string report_html(const ReportPage& page) {
    return fill_template(
        page_html, {{"VERSION", std::string(version())},
                    {"NAME_A", escape_html(name_of(page.a))},
                    {"NAME_B", escape_html(name_of(page.b))},
                    {"STYLE", fill_template(page_style, {{"RAMP", ramp_stops()}})},
                    {"SUMMARY", escape_html(comparison_text(page.a, page.b, page.comparison))},
                    {"VIEW", view(page)},
                    {"TABLES", counts_table(page.a, page.b) + distances_table(page) + colors_table(page)},
                    {"NOTES", notes(page)},
                    {"PICTURES", pictures(page)},
                    {"SCRIPTS", scripts(page)}});
}

}  // namespace faqem::cli
