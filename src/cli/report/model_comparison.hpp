#pragma once
/// \file
/// Everything that is measured between two models.

#include <optional>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/compare.hpp"
#include "faqem/compare_colors.hpp"

namespace faqem::cli {

/// A model, and all its instances in world space as one mesh.
struct FlattenedModel {
    std::string file;
    Asset asset;
    Part flat;

    MeshView view() const { return {flat.positions, flat.triangles}; }
};

/// \throws ReadError, InputError (also where no face has area), UnsupportedError
FlattenedModel load_flattened(const std::string& file);

struct ModelComparison {
    Comparison distances;
    std::optional<ColorComparison> colors;  ///< none: a model says nothing of colours, or see the warning
    std::string colors_warning;             ///< why an image cannot be read; that withholds no distances
    MeshInfo a, b;
};

/// \param a  the original
ModelComparison compare_models(const FlattenedModel& a, const FlattenedModel& b,
                               const CompareOptions& options);

}  // namespace faqem::cli
