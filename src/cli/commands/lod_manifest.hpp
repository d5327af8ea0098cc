#pragma once
/// \file
/// What faqem lod says of its levels.

#include <cstdint>
#include <string>
#include <vector>

#include "cli/json.hpp"
#include "faqem/report.hpp"

namespace faqem::cli {

/// How the levels will be looked at.
struct ViewSettings {
    double pixel_error = 1;              ///< how many pixels a level may be off
    double fov = 60;                     ///< vertical angle of view, degrees in (0, 180)
    std::uint32_t screen_height = 1080;  ///< pixels
};

/// One level, as it was written.
struct WrittenLevel {
    std::string file;
    std::uint64_t faces = 0, vertices = 0;
    double distance = 0, error = 0;  ///< as SimplifiedAssetLevel
    const Report* report = nullptr;  ///< null: the original
};

/// Distance of the eye from the nearest point of the model from which an error covers no more pixels than
/// allowed.
double switch_distance(double error, const ViewSettings& view_settings);

/// The error that covers so many pixels where the eye is `distance` from the nearest point of the model.
double error_from_pixels(double pixels, double distance, const ViewSettings& view_settings);

/// Share of the screen's height that a length takes at the switch distance; infinity where that is 0.
double screen_coverage(double diagonal, double error, const ViewSettings& view_settings);

/// The manifest, with the keys documented in docs/levels.md.
/// \param diagonal  of the scene
Json lod_manifest(const std::string& source, double diagonal, const ViewSettings& view_settings,
                  const std::vector<WrittenLevel>& levels);

}  // namespace faqem::cli
