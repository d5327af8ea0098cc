#include "faqem/save_levels.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "asset/file_format.hpp"
#include "asset/finest_level.hpp"
#include "asset/gltf/write/levels.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/part_arrays.hpp"
#include "faqem/error.hpp"

namespace faqem {

namespace {

namespace fs = std::filesystem;

void check_levels(const std::vector<SavedLevel>& levels) {
    if (levels.empty()) throw InputError("", "levels", "at least one level is required");
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const std::size_t parts = levels[i].asset.parts.size();
        if (parts != levels[0].asset.parts.size())
            throw InputError("", "level " + std::to_string(i),
                             "must have the same number of parts as level 0");
        if (levels[i].coverage.size() != parts)
            throw InputError("", "level " + std::to_string(i), "must have one coverage value per part");
    }
}

/// Returns the index of an image with the same bytes; appends the image if there is none.
Index add_image(std::vector<Image>& images, Image&& image) {
    const auto same = std::ranges::find_if(
        images, [&](const Image& other) { return !image.encoded.empty() && other.encoded == image.encoded; });
    const auto index = static_cast<Index>(same - images.begin());
    if (same == images.end()) images.push_back(std::move(image));
    return index;
}

/// Appends the parts of a level, with their materials and images, as parts without a source mesh.
void append_level(Asset& to, Asset&& level) {
    std::vector<Index> image_map;
    for (Image& own : level.images) image_map.push_back(add_image(to.images, std::move(own)));
    const auto first_material = static_cast<Index>(to.materials.size());
    for (Material& material : level.materials) {
        detail::for_each_texture(material, [&](TextureRef& ref) {
            if (ref) ref.image = image_map[ref.image];
        });
        to.materials.push_back(std::move(material));
    }
    for (Part& part : level.parts) {
        for (Index& material : part.face_material)
            if (material != no_index) material += first_material;
        part.source = no_index;
        to.parts.push_back(std::move(part));
    }
}

/// Values of MSFT_screencoverage for one part, one per level: the coverage below which the next level is
/// used, non-increasing and at most 1. The last value is 0.
std::vector<double> coverage_of(const std::vector<SavedLevel>& levels, std::size_t part) {
    std::vector<double> coverage;
    for (std::size_t i = 1; i < levels.size(); ++i) {
        const double max_coverage = coverage.empty() ? 1 : coverage.back();
        const double wanted = levels[i].coverage[part];
        coverage.push_back(wanted < max_coverage ? wanted : max_coverage);  // also clamps NaN
    }
    coverage.push_back(0);
    return coverage;
}

}  // namespace

std::vector<std::string> save_levels(std::vector<SavedLevel> levels, const fs::path& file,
                                     Overwrite overwrite) {
    const detail::FileFormat* format = detail::format_by_name(file);
    if (!format || !format->encode_levels)
        throw UnsupportedError(file.string(), "",
                               "cannot hold levels: the name must end in " +
                                   detail::listed_extensions(detail::FormatUse::write_levels));
    check_levels(levels);
    for (SavedLevel& level : levels) detail::keep_finest_level(level.asset);
    for (SavedLevel& level : levels)
        if (std::optional<detail::DividedAsset> divided = detail::divided_into_objects(level.asset)) {
            level.asset = std::move(divided->asset);
            level.coverage = detail::gather(level.coverage, divided->part);
        }
    check_levels(levels);
    const std::size_t parts = levels[0].asset.parts.size();
    detail::LeveledAsset leveled;
    leveled.parts_per_level = parts;
    for (std::size_t p = 0; p < parts; ++p) leveled.coverage.push_back(coverage_of(levels, p));
    for (std::size_t i = 0; i < levels.size(); ++i)
        for (const Part& part : levels[0].asset.parts) leveled.sources.push_back(part.source);
    leveled.asset = std::move(levels[0].asset);
    for (std::size_t i = 1; i < levels.size(); ++i) append_level(leveled.asset, std::move(levels[i].asset));
    detail::EncodedModel model = format->encode_levels(leveled, file);
    detail::write_model(model, file.parent_path(), overwrite);
    return std::move(model.losses);
}

}  // namespace faqem
