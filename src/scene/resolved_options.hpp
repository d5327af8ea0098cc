#pragma once
/// \file
/// The options of a run for an asset: what is automatic is chosen by the source and the format of the result.

#include "faqem/asset.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Chooses what the options leave open and the format of the result decides; see docs/assets.md, "Results for a format".
/// * Options::format becomes that of the file that the source was loaded from.
/// * Bake::automatic becomes Bake::none or Bake::vertex where the format has no textures, and Bake::none for a source
///   without appearance where the format needs no material; Bake::keep if it has UVs, or vertex colours that are
///   classes. Normals that the format cannot hold are not transferred.
///   Untouched parts are baked where the format lacks parts of the materials of the source.
/// * Vertices are rounded for glTF only.
/// * Images that are passed through cannot be baked: instead of new textures or vertex colours, the UVs and images of
///   the source are kept.
/// Options that are resolved already stay as they are.
/// \throws OptionError  ImageFormat::webp or Quantize::on is asked for, and the format is not glTF
/// Complexity: O(faces + images).
Options resolved_options(const Asset& source, Options options);

/// Warnings of options that a user has given, and that have no effect on this source: idle_options() of a table.
/// \throws whatever resolved_options() throws
FAQEM_EXPORT std::vector<std::string> idle_options(const Asset& source, const Options& options,
                                                   std::span<const std::string_view> names,
                                                   OptionSpelling spelling);

/// Whether the options leave it to bake() to keep UVs: Bake::automatic without any option that is about a new atlas
/// or about the collapses.
bool may_keep_uvs(const Options& options);

}  // namespace faqem::detail
