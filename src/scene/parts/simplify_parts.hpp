#pragma once
/// \file
/// Simplification of all parts of an asset to one or more targets.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "faqem/bake.hpp"
#include "faqem/detail/lod/lod_chain.hpp"

namespace faqem::detail {

/// With preset balanced, the results of a part of an asset with images are fitted to the original, as by preset best, if they
/// keep no attributes, have at most this number of faces, and the part at most that one: it takes a small share of the time of baking.
inline constexpr std::size_t most_fitted_faces = 2000, most_faces_to_fit = 200'000;

/// As run_to_targets(), for assets. Every target is distributed over the parts according to Options::budget,
/// and every part is simplified from one level to the next.
/// \param source   must have passed check_asset()
/// \param targets  face counts of all parts together: at least one, in descending order
/// \param options  must be valid
/// \param levels   what the targets are for, at least as many: a target that was found for a distance is distributed by
///                 error alone. Empty: all targets were asked for, and Options::budget may limit how little a part gets
/// \return one result per target
/// \throws engine::Cancelled if the progress callback cancels
std::vector<SimplifiedParts> simplify_parts_to_targets(const Asset& source,
                                                       std::span<const std::uint64_t> targets,
                                                       const Options& options, const RunContext& context,
                                                       std::span<const LevelTarget> levels = {});

/// As simplify_parts() without Options::max_error, for a source that is welded (WeldedSource).
/// \param source   must have passed check_asset()
/// \param options  must be valid, without max_error
/// \param levels   as for simplify_parts_to_targets()
SimplifiedParts simplify_welded_parts(const Asset& source, const Options& options, const RunContext& context,
                                      std::span<const LevelTarget> levels = {});

/// Simplifies the part of an index; nothing if that is not possible.
using SimplifyPart = std::function<std::optional<SimplifyResult>(std::size_t, const MeshView&, const Options&,
                                                                 const RunContext&)>;

/// As simplify_welded_parts(), but each part is simplified by a function, and none again with its UVs.
/// \return nothing if the function returned nothing for a part
std::optional<SimplifiedParts> simplify_each_part(const Asset& source, const Options& options,
                                                  const RunContext& context, const SimplifyPart& simplify);

/// simplify_parts() to several targets in one run, with the kind of baking that the options say: Bake::automatic makes no
/// SimplifiedParts::with_uvs.
/// \param targets    face counts of all parts together: at least one, in descending order
/// \param requested  as for simplify_parts(); target and max_error are ignored
/// \return one result per target
/// \throws whatever simplify_parts() throws, and engine::Cancelled
/// Complexity: that of one call of simplify_parts(), and O(faces) for each target.
std::vector<SimplifiedParts> simplify_parts_in_steps(const Asset& source,
                                                     std::span<const std::uint64_t> targets,
                                                     const Options& requested, const RunContext& context);

/// simplify_parts() as a part of the call that has the context. \throws also engine::Cancelled
SimplifiedParts simplify_parts(const Asset& source, const Options& requested, const RunContext& context);

}  // namespace faqem::detail
