#pragma once
/// \file
/// Options::max_error for a scene.

#include <cstdint>
#include <vector>

#include "bake/scene/scene_size.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/simplify/error_bound_search.hpp"

namespace faqem::detail {

/// The parts of an asset to measure several results against.
class ReferenceParts {
public:
    /// \param options  of the runs; borrowed
    /// \throws InputError  an index is out of range
    ReferenceParts(const Asset& source, const Options& options, CancellationCheck check_cancelled = {});

    const SceneSize& size() const { return size_; }
    /// Of all parts.
    std::uint64_t faces() const { return faces_; }
    /// In the units of the scene, the largest of all parts.
    MeasuredDistance operator()(const SimplifiedParts& simplified, double allowed, MeasureMode mode,
                                CancellationCheck check_cancelled) const;

private:
    const Options& options_;
    SceneSize size_;
    std::vector<DistanceReference> originals_;
    std::uint64_t faces_ = 0;
};

/// simplify_parts() with max_error: searches over the face count of the whole asset, one call of
/// simplify_parts() for each try.
/// \pre options are valid
SimplifiedParts simplify_parts_within_error(const Asset& source, const Options& options);

}  // namespace faqem::detail
