#pragma once
/// \file
/// `faqem simplify --max-bytes`: reduces faces and images until the output files fit into a byte budget.

#include <cstdint>
#include <filesystem>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

/// Thrown if even the smallest result exceeds the byte budget. The command exits with code 10.
class BudgetError : public Error {
public:
    using Error::Error;
};

/// BakeOptions::image_quality of a result that has too many bytes at the wanted quality.
inline constexpr double low_image_quality = 34;

/// A byte budget for the files of one model.
struct ByteBudget {
    std::uint64_t bytes = 0;     ///< total size of all files, > 0
    std::filesystem::path file;  ///< name of the output; its extension selects the format
};

/// Size of the files of a model.
struct ModelBytes {
    std::uint64_t geometry = 0;  ///< bytes other than those of images
    std::uint64_t images = 0;    ///< bytes of encoded images

    std::uint64_t total() const { return geometry + images; }
};

/// Returns the size of the files that save() would write for `file`.
/// \throws WriteError        the format cannot hold the asset
/// \throws UnsupportedError  the format of `file` cannot be written
ModelBytes model_bytes(const Asset& asset, const std::filesystem::path& file);

/// Calls simplify() and, while the result exceeds the budget, reduces it in this order:
/// 1. fewer faces, until the geometry takes at most half of the budget, or what existing images leave of it
///    if no image is baked;
/// 2. smaller baked images: with ImageFormat::automatic a lower quality, then half the side, repeatedly, down to
///    64 texels;
/// 3. fewer faces, if the smallest images leave less than half of the budget.
/// Returns the first result that fits. If anything was reduced, the report has a warning with the sizes.
/// Complexity: at most 8 simplifications for each of steps 1 and 3, and 9 bakes in step 2, each with a
/// quarter of the texels of the previous one.
/// \param options  target and texture size are upper limits; max_error must be unset
/// \throws BudgetError  no result fits
/// \throws TimeLimitError  Options::max_seconds, which holds for all runs together, was over before a result fitted
/// \throws whatever simplify() and model_bytes() throw
SimplifiedAsset simplify_within_bytes(const Asset& source, const Options& options, const ByteBudget& budget);

}  // namespace faqem::cli
