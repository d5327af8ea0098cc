#pragma once
/// \file
/// simplify --max-bytes: fewer faces and smaller images until the files are small enough.

#include <cstdint>
#include <filesystem>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

/// No result is as small as it was asked to be. The tool exits with 10.
class BudgetError : public Error {
public:
    using Error::Error;
};

/// Who chose the encoding of the images: one that the user named stays.
enum class ImageEncodingChoice { automatic, user_specified };

/// A byte budget for the files of one model.
struct ByteBudget {
    std::uint64_t bytes = 0;     ///< all files together, > 0
    std::filesystem::path file;  ///< the result's name: its extension decides what is counted
    ImageEncodingChoice encoding = ImageEncodingChoice::automatic;
};

/// What a model takes on disk.
struct ModelBytes {
    std::uint64_t geometry = 0;  ///< all but the images
    std::uint64_t images = 0;

    std::uint64_t total() const { return geometry + images; }
};

/// Saves the asset to a temporary folder and counts. \throws WriteError, UnsupportedError
ModelBytes model_bytes(const Asset& asset, const std::filesystem::path& file);

/// simplify(), and where the result is larger than the budget:
/// 1. fewer faces, until what is not images takes half of the budget, or what the images leave if these are
///    not baked anew;
/// 2. images that are baked: JPEG instead of PNG unless the encoding is as asked, then half the side, again
///    and again, down to 64 texels;
/// 3. fewer faces still, where the smallest images leave less than half.
/// The first result that fits is taken; a warning says what was given up.
/// \param options  its target and texture size are the most there will be; without max_error
/// \throws BudgetError  nothing fits
/// \throws as simplify() and model_bytes()
/// At most 8 simplifications for each of 1 and 3, and 9 bakings, each a quarter of the one before.
SimplifiedAsset simplify_within_bytes(const Asset& source, const Options& options, const ByteBudget& budget);

}  // namespace faqem::cli
