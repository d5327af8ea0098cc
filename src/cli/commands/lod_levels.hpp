#pragma once
/// \file
/// Levels of `faqem lod`: as they are given, with their switch distances, and in the manifest that is written.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/process/json.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"
#include "faqem/levels.hpp"
#include "faqem/report.hpp"
#include "faqem/report_json.hpp"

namespace faqem::cli {

/// The view for which switch distances are computed.
struct ViewSettings {
    double pixel_error = 1;              ///< allowed error on the screen, pixels
    double fov = 60;                     ///< vertical field of view, degrees in (0, 180)
    std::uint32_t screen_height = 1080;  ///< pixels
};

/// Data of one level for the manifest.
struct WrittenLevel {
    std::string file;                       ///< name of the file, without its directory
    std::uint64_t faces = 0, vertices = 0;  ///< sums over all parts
    std::uint64_t bytes = 0;                ///< of the files of the level; 0 in a file of all levels
    double distance = 0, error = 0;         ///< as in SimplifiedAssetLevel
    std::optional<Report> report;           ///< nothing for the original
};

/// Height of the view frustum at distance 1.
inline double view_height_at_unit_distance(const ViewSettings& view_settings) {
    return 2 * std::tan(view_settings.fov / 2 * std::numbers::pi / 180);
}

/// Returns the distance between the camera and the nearest point of the model from which on an error covers
/// at most the allowed number of pixels, model units.
inline double switch_distance(double error, const ViewSettings& view_settings) {
    return error * view_settings.screen_height /
           (view_height_at_unit_distance(view_settings) * view_settings.pixel_error);
}

/// Parses one level: `0.5` or `50%` (ratio of faces), `5000` (number of faces), `error:0.01` (distance in model units),
/// `error:0.1%` (distance relative to the diagonal) or `pixels:2@50` (an error that covers at most 2 pixels at a distance
/// of 50 model units from the camera).
/// \throws OptionError  the text has another form
inline Level parse_level(const std::string& text, const ViewSettings& view_settings) {
    using detail::OptionKind;
    const auto parse = [](std::string_view number, OptionKind kind) {
        return detail::parse_option_number(number, kind, {.excludes_min = true}, "", "--levels");
    };
    constexpr std::string_view distance = "error:", pixels = "pixels:";
    if (text.starts_with(distance)) {
        const detail::OptionValue length = parse(text.substr(distance.size()), OptionKind::length);
        return Length{*length.number, length.unit};
    }
    if (text.starts_with(pixels)) {
        const std::string rest = text.substr(pixels.size());
        const std::size_t at = rest.find('@');
        if (at == std::string::npos)
            throw OptionError("--levels: '" + text + "' is not pixels:N@DISTANCE with two numbers");
        const double size = *parse(rest.substr(0, at), OptionKind::number).number,
                     from = *parse(rest.substr(at + 1), OptionKind::number).number;
        return model_units(size * view_height_at_unit_distance(view_settings) * from /
                           view_settings.screen_height);
    }
    const double value = *parse(text, OptionKind::share).number;
    if (value <= 1) return ratio(value);
    if (!(!text.ends_with('%') && value < 1e15 && value == std::floor(value)))
        throw OptionError("--levels: '" + text + "' is neither a ratio in (0, 1] nor a number of faces");
    return faces(static_cast<std::uint64_t>(value));
}

/// Returns the manifest as JSON with the keys documented in docs/levels.md.
/// \param source    name of the input file
/// \param diagonal  of the bounding box of the scene, model units
inline Json lod_manifest(const std::string& source, double diagonal, const ViewSettings& view_settings,
                         const std::vector<WrittenLevel>& levels) {
    Json json = {{"source", source},
                 {"diagonal", diagonal},
                 {"pixel_error", view_settings.pixel_error},
                 {"fov_degrees", view_settings.fov},
                 {"screen_height", view_settings.screen_height},
                 {"levels", Json::array()}};
    for (const WrittenLevel& level : levels) {
        const double from = switch_distance(level.error, view_settings);
        Json one = {{"file", level.file},         {"faces", level.faces}, {"vertices", level.vertices},
                    {"distance", level.distance}, {"error", level.error}, {"switch_distance", from}};
        // The share of the screen height that the diagonal covers; null for the original, which is shown at any.
        one["screen_coverage"] =
            from > 0 ? Json(diagonal / (view_height_at_unit_distance(view_settings) * from)) : Json();
        if (level.bytes > 0) one["bytes"] = level.bytes;
        if (level.report) one["report"] = Json::parse(to_json(*level.report));
        json["levels"].push_back(std::move(one));
    }
    return json;
}

}  // namespace faqem::cli
