#pragma once
/// \file
/// How far pictures of a simplified scene differ from those of its source: with the source's UVs, and with new
/// images that reproduce the source at every point.

#include <array>
#include <cstdint>
#include <span>

#include "bake/parts/corners.hpp"
#include "bake/source/source_sampler.hpp"
#include "bake/texture/picture_difference.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// How far pictures of two versions of the same parts differ from those of the source.
struct KeptAndBaked {
    PictureDifference kept, baked;
};

/// What is compared.
struct ComparedScenes {
    const Asset& source;
    std::span<const BakePart> parts;      ///< of `source`; those that would be baked have maps and normals
    const SourceSampler& source_sampler;  ///< of `source`: base colours and normals
    const Asset& kept;                    ///< the parts with kept UVs, by index of the source
    const SourceSampler& kept_sampler;    ///< of `kept`
    /// By part: side of a texel that a new page would have, in the part's units.
    std::span<const double> page_texels;
    std::span<const std::uint8_t> gets_normal_map;  ///< by part: whether a new page has a normal map
};

/// Sides in pixels of the pictures that are compared: small ones, in which textures are filtered, and large ones.
inline constexpr std::array<std::uint32_t, 2> compared_sizes = {384, 1152};

/// Outcome of compare_pictures().
struct ComparedPictures {
    std::array<KeptAndBaked, 2> differences;  ///< by compared size; NaN without points
    std::uint64_t points = 0;                 ///< pixels that show something
};

/// Whether a part shows single texels of base colours, without filter. A new page would blur them.
/// Complexity: O(faces log faces).
bool shows_single_texels(const Asset& asset, const Part& part);

/// Compares some parts in 6 pictures that show all of them, from directions all around, each at its first instance. New
/// images are taken to be perfect: the colours are those of the source, at the points that the map gives, and blurred
/// by a texel of the page, also at borders of materials and of single texels.
/// \param parts  indices of parts that have faces in the source and in both versions
/// \param size   number of rows and columns of points that are compared in each picture
/// \throws engine::Cancelled
/// Complexity: O(faces + size^2 log faces). The result does not depend on the number of threads.
ComparedPictures compare_pictures(const ComparedScenes& scenes, std::span<const Index> parts,
                                  std::uint32_t size, const RunContext& context);

}  // namespace faqem::detail
