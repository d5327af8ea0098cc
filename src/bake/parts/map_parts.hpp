#pragma once
/// \file
/// The simplified parts with what every kind of baking needs: surface maps and normals.

#include <cstdint>
#include <span>
#include <vector>

#include "bake/parts/corners.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// Makes the surface maps and the normals of all parts that are not kept.
/// \param source, simplified  by part; must outlive the result
/// \param kept  by part: BakePart::is_kept
/// \return by part of the source
/// \throws engine::Cancelled
std::vector<BakePart> map_parts(const Asset& source, std::span<const SimplifyResult> simplified,
                                std::span<const std::uint8_t> kept, const BakeOptions& bake,
                                const RunContext& context);

}  // namespace faqem::detail
