#pragma once
/// \file
/// Two-sided colour differences of textured models.

#include <cstdint>

#include "faqem/asset.hpp"
#include "faqem/compare.hpp"
#include "faqem/export.hpp"

namespace faqem {

/// Colour differences from one model to the other. Shares are in [0, 1].
struct OneSidedColors {
    double mean_squared = 0;  ///< difference per channel, of samples that count
    double rmse = 0;          ///< its root: 0 to 1
    double outliers = 0;      ///< share of those samples whose colours are more than 0.25 apart (Euclidean)
    double unmatched =
        0;              ///< share of those samples for which the other model has no face that looks their way
    double hidden = 0;  ///< share of all samples that are masked out, which do not count
};

/// How far the colours of two models differ.
struct ColorComparison {
    OneSidedColors a_to_b, b_to_a;
    double rmse = 0;  ///< root of the mean of both mean squares
    double psnr = 0;  ///< -20 log10(rmse), decibels; infinity where nothing differs
};

/// Whether a model has anything that says a colour: materials or vertex colours.
FAQEM_EXPORT bool has_colors(const Asset& asset);

/// Compares base colours (texture times factor times vertex colour, without light), as sRGB in 0 to 1: area-
/// uniform samples of each model, the same places as compare() takes, against the closest point of the other
/// model on a face that looks the same way (normals less than 90 degrees apart; of all faces where there is
/// none). A face looks to the side of its corners' normals where the model has them, else of its winding. All
/// instances are placed in the scene. Textures are read at their full size, bilinearly or as their filter
/// says. Alpha is not compared; where it masks, samples below the cutoff are left out.
/// \param options  samples, seed and threads; the result does not depend on the threads
/// \throws InputError        a model has no face with area, or an image is damaged
/// \throws UnsupportedError  an image is neither PNG nor JPEG
/// Complexity: O(samples log faces) typically; about 400 bytes per face, 7 per texel.
FAQEM_EXPORT ColorComparison compare_colors(const Asset& a, const Asset& b,
                                            const CompareOptions& options = {});

}  // namespace faqem
