#pragma once
/// \file
/// Which face counts and images to try for a byte budget, from the bytes and errors of both apart.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cli/picture_error.hpp"

namespace faqem::cli {

/// Geometry that was tried, with perfect images.
struct TriedFaces {
    std::uint64_t faces = 0;
    std::uint64_t bytes = 0;
    PictureError error;
};

/// Images that were tried, on all faces.
struct TriedImages {
    std::uint32_t side = 0;         ///< limit of the sides, texels
    std::optional<double> quality;  ///< BakeOptions::image_quality
    std::uint64_t bytes = 0;
    PictureError error;
};

/// A face count and images that should fit.
struct BudgetChoice {
    std::size_t images = 0;  ///< index
    std::uint64_t faces = 0;
    double psnr = 0;  ///< expected, dB
};

/// The largest face count whose geometry has at most `bytes`, interpolated between those that were tried; nothing if
/// all have more. O(tried)
/// \param tried  at least one, in descending order of faces
std::optional<std::uint64_t> faces_within(std::span<const TriedFaces> tried, std::uint64_t bytes);

/// The error of a face count, interpolated. \param tried  as for faces_within() O(tried)
PictureError error_of_faces(std::span<const TriedFaces> tried, std::uint64_t faces);

/// For each set of images that leaves bytes for faces, the face count that fits; the best first, equal ones in the order
/// of the images. O(images * (faces + log images))
std::vector<BudgetChoice> budget_choices(std::span<const TriedFaces> faces,
                                         std::span<const TriedImages> images, std::uint64_t bytes);

}  // namespace faqem::cli
