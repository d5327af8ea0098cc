#pragma once
/// \file
/// Comparison of two models, shared by `faqem compare` and `faqem report`.

#include <optional>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/compare.hpp"
#include "faqem/compare_colors.hpp"

namespace faqem::cli {

/// A model as loaded, and all its instances in world space as one mesh.
struct FlattenedModel {
    std::string file;
    Asset asset;
    Part flat;      ///< world space
    MeshInfo info;  ///< of `flat`

    /// Returns a view of `flat`. Valid while this object is not changed.
    MeshView view() const { return {flat.positions, flat.triangles}; }
};

/// Loads a model, welds positions that differ by rounding as in simplify and info, and flattens it. Asset::warnings lists
/// what was welded.
/// \throws ReadError         the file cannot be read
/// \throws InputError        the file is damaged, or no face has a non-zero area
/// \throws UnsupportedError  the format or a feature of the file is not supported
FlattenedModel load_flattened(const std::string& file);

struct ModelComparison {
    Comparison distances;
    std::optional<ColorComparison> colors;  ///< none if a model has no colours or `colors_warning` is set
    std::string colors_warning;             ///< reason why colours cannot be compared; otherwise empty
};

/// Compares two models. If their colours cannot be compared, the distances are computed nevertheless.
/// \param a  the original, whose diagonal is the unit of relative distances
ModelComparison compare_models(const FlattenedModel& a, const FlattenedModel& b,
                               const CompareOptions& options);

/// What a comparison of two models found, for people: a sentence in each line.
std::string comparison_text(const FlattenedModel& a, const FlattenedModel& b,
                            const ModelComparison& comparison);

}  // namespace faqem::cli
