#include "cli/commands/lod_manifest.hpp"

#include <cmath>
#include <numbers>
#include "faqem/report_json.hpp"

namespace faqem::tool {

namespace {

// Height of what the screen shows at distance 1.
double height_at_one(const Viewing& viewing) {
    return 2 * std::tan(viewing.fov / 2 * std::numbers::pi / 180);
}

}  // namespace

double switch_distance(double error, const Viewing& viewing) {
    return error * viewing.screen_height / (height_at_one(viewing) * viewing.pixel_error);
}

double error_of_pixels(double pixels, double distance, const Viewing& viewing) {
    return pixels * height_at_one(viewing) * distance / viewing.screen_height;
}

double screen_coverage(double diagonal, double error, const Viewing& viewing) {
    return diagonal / (height_at_one(viewing) * switch_distance(error, viewing));
}

Json lod_manifest(const std::string& source, double diagonal, const Viewing& viewing,
                  const std::vector<WrittenLevel>& levels) {
    Json json = {{"source", source},
                 {"diagonal", diagonal},
                 {"pixel_error", viewing.pixel_error},
                 {"fov_degrees", viewing.fov},
                 {"screen_height", viewing.screen_height},
                 {"levels", Json::array()}};
    for (const WrittenLevel& level : levels) {
        const double from = switch_distance(level.error, viewing);
        Json one = {{"file", level.file},         {"faces", level.faces}, {"vertices", level.vertices},
                    {"distance", level.distance}, {"error", level.error}, {"switch_distance", from}};
        // The original is shown however large it is.
        one["screen_coverage"] = from > 0 ? Json(screen_coverage(diagonal, level.error, viewing)) : Json();
        if (level.report) one["report"] = Json::parse(to_json(*level.report));
        json["levels"].push_back(std::move(one));
    }
    return json;
}

}  // namespace faqem::tool
