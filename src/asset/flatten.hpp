#pragma once
/// \file
/// A scene as one part, for formats without a scene graph.

#include <filesystem>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// All instances of all parts in world space, one after the other. Normals go by the inverse transpose and
/// have unit length; mirrored instances have their winding turned round. Attributes that only some parts have
/// get neutral values elsewhere: normals and UVs zero, colours white. Tangents, skins and morph targets are
/// left out. A part that is alone and stays where it is comes out with the same bits.
/// \throws InputError  when there are more vertices or faces than 32-bit indices can tell apart
FAQEM_EXPORT Part flatten(const Asset& asset);

/// The same for these instances instead of those of the asset's scene.
Part flatten(const Asset& asset, const std::vector<Instance>& all);

/// What flatten() leaves out of this asset, one sentence each.
/// \param format  name of the format for the sentences
std::vector<std::string> flattening_losses(const Asset& asset, const std::string& format);

/// True when all coordinates are floats exactly.
bool is_float_representable(const std::vector<Vec3>& positions);

}  // namespace faqem::detail
