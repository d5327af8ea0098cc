#include "cli/commands/lod_levels.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"
#include "faqem/report_json.hpp"

namespace faqem::cli {

namespace {

// Height of the view frustum at distance 1.
double view_height_at_unit_distance(const ViewSettings& view_settings) {
    return 2 * std::tan(view_settings.fov / 2 * std::numbers::pi / 180);
}

}  // namespace

double switch_distance(double error, const ViewSettings& view_settings) {
    return error * view_settings.screen_height /
           (view_height_at_unit_distance(view_settings) * view_settings.pixel_error);
}

double error_from_pixels(double pixels, double distance, const ViewSettings& view_settings) {
    return pixels * view_height_at_unit_distance(view_settings) * distance / view_settings.screen_height;
}

double screen_coverage(double diagonal, double error, const ViewSettings& view_settings) {
    return diagonal / (view_height_at_unit_distance(view_settings) * switch_distance(error, view_settings));
}

Level parse_level(const std::string& text, const ViewSettings& view_settings) {
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
        return model_units(error_from_pixels(*parse(rest.substr(0, at), OptionKind::number).number,
                                             *parse(rest.substr(at + 1), OptionKind::number).number,
                                             view_settings));
    }
    const double value = *parse(text, OptionKind::share).number;
    if (value <= 1) return ratio(value);
    if (!(!text.ends_with('%') && value < 1e15 && value == std::floor(value)))
        throw OptionError("--levels: '" + text + "' is neither a ratio in (0, 1] nor a number of faces");
    return faces(static_cast<std::uint64_t>(value));
}

Json lod_manifest(const std::string& source, double diagonal, const ViewSettings& view_settings,
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
        // null for the original: it is shown at any screen coverage.
        one["screen_coverage"] =
            from > 0 ? Json(screen_coverage(diagonal, level.error, view_settings)) : Json();
        if (level.bytes > 0) one["bytes"] = level.bytes;
        if (level.report) one["report"] = Json::parse(to_json(*level.report));
        json["levels"].push_back(std::move(one));
    }
    return json;
}

}  // namespace faqem::cli
