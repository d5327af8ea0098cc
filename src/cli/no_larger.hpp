#pragma once
/// \file
/// The rule that a simplified textured model has no more bytes than its source.

#include <cstdint>
#include <filesystem>

#include "faqem/bake.hpp"

namespace faqem::cli {

/// Whether a result with more bytes than its source gives something up.
enum class LargerResult {
    gives_up,  ///< what simplify_no_larger() lists
    warns,     ///< nothing, because the images were asked for; there is a warning
    allowed,   ///< nothing, without a warning
};

/// What a result is compared with.
struct SizeRule {
    std::filesystem::path out;   ///< name of the output; its extension selects the format
    std::uint64_t bytes_in = 0;  ///< total size of the files of the source
    LargerResult larger = LargerResult::gives_up;
};

/// The rule for options as they were given: images that were asked for are not given up.
/// \param allow_larger  whether the rule is turned off
LargerResult larger_result(const BakeOptions& bake, bool allow_larger);

/// Calls bake(). If the result has new images and its files would have more bytes than those of the source,
/// these are encoded again with less, until they have not: without the normal map, if the source has none; then
/// with BakeOptions::image_quality 34, 29 and 24. Nothing is given up if the geometry alone is larger, and
/// untouched parts stay as they are. A warning says what was given up, and another one if the result is larger
/// nevertheless.
/// \throws whatever bake() and model_bytes() throw
/// Complexity: that of bake(), and of encoding its images up to four more times.
SimplifiedAsset bake_no_larger(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                               const SizeRule& rule);

/// Calls simplify_parts() and bake_no_larger().
SimplifiedAsset simplify_no_larger(const Asset& source, const Options& options, const SizeRule& rule);

}  // namespace faqem::cli
