#pragma once
/// \file
/// Comparison of the colours of two textured models.

#include "faqem/asset.hpp"
#include "faqem/compare.hpp"
#include "faqem/export.hpp"

namespace faqem {

/// One-sided colour differences from one model to the other. Colours are sRGB, each channel in [0, 1].
struct OneSidedColors {
    double mean_squared = 0;  ///< mean squared difference per channel, over the visible samples
    double rmse = 0;          ///< square root of mean_squared, in [0, 1]
    double outliers = 0;      ///< share of the visible samples that differ by more than 0.25 (Euclidean)
    double unmatched = 0;     ///< share of the visible samples without a face of similar orientation
    double hidden = 0;        ///< share of all samples that an alpha mask cuts away; the others are visible
};

/// Two-sided colour differences of two models.
struct ColorComparison {
    OneSidedColors a_to_b, b_to_a;
    double rmse = 0;  ///< square root of the mean of both mean_squared
    double psnr = 0;  ///< -20 log10(rmse), decibels; infinity if nothing differs
};

/// Tests whether a model has colours: a material, or vertex colours.
FAQEM_EXPORT bool has_colors(const Asset& asset);

/// Compares the unlit base colours (texture times factor times vertex colour) of two models in sRGB.
///
/// Area-uniform samples of each model, at the same positions as in compare(), are compared with the closest
/// point of the other model on a face of similar orientation (normals less than 90 degrees apart), or on any
/// face if there is none. The orientation of a face is that of its vertex normals if the model has them, else
/// that of its winding. All instances of a scene are in world space. Textures are sampled at full resolution,
/// with their filter. Alpha is not compared; samples below the cutoff of an alpha mask are left out.
/// \param a,b      models; only read during the call
/// \param options  samples, seed and threads; the tolerance is ignored
/// \throws InputError        a model has no face with a non-zero area, or an image is damaged
/// \throws UnsupportedError  an image has a format that decode() does not support
/// Complexity: O(samples log faces) typically; about 400 bytes per face, 7 per texel.
FAQEM_EXPORT ColorComparison compare_colors(const Asset& a, const Asset& b,
                                            const CompareOptions& options = {});

}  // namespace faqem
