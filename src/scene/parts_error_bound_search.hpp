#pragma once
/// \file
/// Simplification of an asset within Options::max_error.

#include <cstdint>
#include <vector>

#include "faqem/bake.hpp"
#include "faqem/detail/simplify/error_bound_search.hpp"
#include "scene/scene_size.hpp"

namespace faqem::detail {

/// The original parts of an asset, to which several results can be compared.
class ReferenceParts {
public:
    /// \param source   the asset; not needed after construction
    /// \param options  options of the runs; must outlive this
    /// \throws InputError if an index is out of range, and whatever `context` throws
    ReferenceParts(const Asset& source, const Options& options, const RunContext& context = {});

    const SceneSize& size() const { return size_; }
    /// Number of faces of all parts.
    std::uint64_t faces() const { return faces_; }
    /// Measures the largest distance of all parts from their originals, in units of the scene. It includes the rounding
    /// of positions that Options::quantize demands.
    /// \param simplified  one result per part
    /// \param allowed     allowed distance, in units of the scene
    /// \param mode        as distance()
    /// \throws OptionError  the rounding alone may be as large as the allowed distance
    /// \throws whatever `context` throws
    MeasuredDistance operator()(const SimplifiedParts& simplified, double allowed, MeasureMode mode,
                                const RunContext& context) const;

private:
    const Options& options_;
    SceneSize size_;
    double rounding_;  // largest distance by which positions are rounded afterwards, units of the scene
    std::vector<DistanceReference> originals_;
    std::uint64_t faces_ = 0;
};

/// simplify_parts() with Options::max_error: a search over the face count of the whole asset, with one call
/// of simplify_welded_parts() per attempt.
/// \param source   must have passed check_asset()
/// \param options  must be valid, with max_error set
SimplifiedParts simplify_parts_within_error(const Asset& source, const Options& options,
                                            const RunContext& context);

}  // namespace faqem::detail
