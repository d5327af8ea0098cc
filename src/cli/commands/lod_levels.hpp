#pragma once
/// \file
/// Levels of `faqem lod`: as they are given, with their switch distances, and in the manifest that is written.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/process/json.hpp"
#include "faqem/levels.hpp"
#include "faqem/report.hpp"

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

/// Returns the distance between the camera and the nearest point of the model from which on an error covers
/// at most the allowed number of pixels, model units.
double switch_distance(double error, const ViewSettings& view_settings);

/// Returns the error that covers `pixels` pixels if the camera has the given distance from the nearest point
/// of the model, model units.
double error_from_pixels(double pixels, double distance, const ViewSettings& view_settings);

/// Returns the share of the screen height that the length `diagonal` covers at the switch distance of
/// `error`; infinity if that distance is 0.
double screen_coverage(double diagonal, double error, const ViewSettings& view_settings);

/// Parses one level: `0.5` or `50%` (ratio of faces), `5000` (number of faces), `error:0.01` (distance in model units),
/// `error:0.1%` (distance relative to the diagonal) or `pixels:2@50` (an error that covers at most 2 pixels at a distance
/// of 50 model units from the camera).
/// \throws OptionError  the text has another form
Level parse_level(const std::string& text, const ViewSettings& view_settings);

/// Returns the manifest as JSON with the keys documented in docs/levels.md.
/// \param source    name of the input file
/// \param diagonal  of the bounding box of the scene, model units
Json lod_manifest(const std::string& source, double diagonal, const ViewSettings& view_settings,
                  const std::vector<WrittenLevel>& levels);

}  // namespace faqem::cli
