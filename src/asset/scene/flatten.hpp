#pragma once
/// \file
/// Flattening of a scene to one part in world space, for formats without a scene graph.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "asset/scene/rest_pose.hpp"
#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// The point to which viewers of 3D Tiles move a scene after they have turned it from y up to z up (CESIUM_RTC); nothing
/// if its file names none.
std::optional<Vec3> scene_center(const Asset& asset);

/// Concatenates all instances of all parts, in world space and in their pose at rest (posed_part()), and moves them to
/// scene_center(). Normals are transformed by the inverse transpose and normalised; the winding of mirrored instances is
/// reversed. Attributes that only some parts have get neutral values in the others: zero normals and UVs, white colours.
/// Tangents, skins and morph targets are left out. With the identity transform, no pose and no center, positions and
/// normals are copied bit for bit.
/// \throws InputError  if there are more vertices or faces than 32-bit indices can address
FAQEM_EXPORT Part flatten(const Asset& asset);

/// Same as above, for the given instances instead of those of the scene of the asset.
Part flatten(const Asset& asset, const std::vector<PosedInstance>& all);

/// The scene as a single part, with its materials and images.
inline Asset flatten_scene(const Asset& asset) {
    Asset result;
    result.parts = {flatten(asset)};
    result.materials = asset.materials;
    result.images = asset.images;
    return result;
}

/// Lists what flatten() leaves out of the asset, one sentence each.
/// \param format  name of the output format, used in the sentences
std::vector<std::string> flattening_losses(const Asset& asset, const std::string& format);

/// Whether all coordinates are exactly representable as float.
bool is_float_representable(const std::vector<Vec3>& positions);

/// The part with the given faces, in their order, and with the vertices that they use, without objects, names and source.
/// \param number  by vertex of the part: scratch memory, no_index everywhere before and after
FAQEM_EXPORT Part with_faces(const Part& part, const std::vector<Index>& faces, std::vector<Index>& number);

/// An asset whose parts are objects.
struct DividedAsset {
    Asset asset;
    std::vector<std::size_t> part;  ///< by part of `asset`: the part that it is taken from
};

/// Makes a part of each object. Objects have the vertices that their faces use, in the same order; those that
/// share vertices each get a copy. Objects without faces become parts without faces, so that all levels of detail have
/// the same parts. Parts without objects are copied.
/// \return none if no part has objects
/// Complexity: O(size of the asset).
std::optional<DividedAsset> divided_into_objects(const Asset& asset);

}  // namespace faqem::detail
