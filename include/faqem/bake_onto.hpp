#pragma once
/// \file
/// Baking of the appearance of an asset onto another mesh. Needs only the standard library.

#include <optional>
#include <string_view>

#include "faqem/asset.hpp"
#include "faqem/bake.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

namespace faqem {

/// Which UVs a target gets.
enum class OntoUvs {
    automatic,  ///< as `keep` if that is possible, otherwise as `created`
    keep,       ///< those of its first set, which must lie in [0, 1] and must not overlap
    created,    ///< those of a new atlas
};

/// What bake_onto() has beside Options.
struct OntoOptions {
    /// Largest distance between a point of the target and the point of the source that it shows, > 0; shares are of the
    /// diagonal of the source. Unset: 5% of it.
    std::optional<Length> max_distance = {};
    OntoUvs uvs = OntoUvs::automatic;
};

/// Options from text.
/// \param uvs           `auto`, `keep`, `new`, or empty
/// \param max_distance  as `0.1`, `2%` of the diagonal, or empty
/// \throws OptionError  a text has another form, or the distance is not above 0
FAQEM_EXPORT OntoOptions onto_options(std::string_view uvs, std::string_view max_distance);

/// Bakes the appearance of one asset onto the surface of another one, which need not be made from it: textures,
/// materials, UVs as OntoOptions::uvs says, and vertex normals where a normal map needs them. Both are taken in scene
/// space, in their poses at rest; a part with several instances gets the appearance at its first one. A point of the
/// target shows the closest point of the source on a face that is turned to the same side, or else on the back of a
/// double-sided one. Where both have several parts, a part does not show what belongs to another one: parts belong
/// together if they have the same name and touch, or else boxes with more than half of their volume in common.
/// The target keeps its nodes, names, skins, morph targets and animations; its materials and vertex colours are
/// replaced. Extensions of materials of the source are baked as by bake(); OBJ files, and files whose materials have
/// numbers (VRM), lose them with a warning. Warnings of the models begin with `source` or `target`.
/// \param source   the appearance
/// \param target   the mesh
/// \param options  those about baking, the format of the result and the run; bake.kind must make an atlas, format have
///                 textures (unset: that of the target, or GLB), and bake.correspondence and max_bytes be unset
/// \return the target with new textures, and the report with its coverage; if the progress callback cancels, report.stop
///     is StopReason::cancelled and the asset is empty
/// \throws OptionError  an option is out of range
/// \throws InputError  arrays or indices of an asset are inconsistent, an image is damaged, an asset has no faces in its
///     scene, a page has fewer texels than charts, OntoUvs::keep is not possible, or no point of the target is near the source
/// \throws UnsupportedError  an image has a format that decode() does not support
/// \throws TimeLimitError  max_seconds was over before the result was complete
/// Complexity: O(n log n) in the faces of both, and O(log n) per texel typically.
FAQEM_EXPORT SimplifiedAsset bake_onto(const Asset& source, const Asset& target, const Options& options = {},
                                       const OntoOptions& onto = {});

}  // namespace faqem
