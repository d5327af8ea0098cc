#pragma once
/// \file
/// Parts that share boundary edges, such as the meshes that an exporter makes of one object, one for each material. They
/// are simplified as one part, because boundaries that are simplified apart leave gaps.

#include <optional>
#include <span>

#include "faqem/bake.hpp"
#include "faqem/export.hpp"
#include "faqem/levels.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Joins parts that share a boundary edge, which their faces pass in opposite directions, as objects (Part::object_parts) of the first one of them; the others are empty.
/// Only parts that move alike (InstanceMotion), with the same vertex attributes, and without objects, morph targets and
/// material variants are joined, in scenes without levels of detail. Histories and correspondences concern single parts,
/// as Budget::mesh does: with them nothing is joined. Neither are parts of whose components few faces will be left.
/// \return the scene, in which other parts are copied; nothing if no parts are joined
/// \throws InputError  as check_asset()
/// Complexity: O(n log n).
FAQEM_EXPORT std::optional<Asset> join_touching_parts(const Asset& source, const Options& options);

/// The same for levels, of which the last target counts.
FAQEM_EXPORT std::optional<Asset> join_touching_parts(const Asset& source, std::span<const Level> levels,
                                                      Options options);

/// Gives the faces of objects that are parts to these parts.
/// \param joined  as join_touching_parts() returns it
/// \param result  has the parts of `joined` with fewer faces; warnings are added for parts without faces
/// Complexity: O(n log n).
void divide_joined_parts(const Asset& joined, SimplifiedAsset& result);

}  // namespace faqem::detail
