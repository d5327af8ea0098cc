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
class MeasuredParts {
public:
    /// \param options  of the runs; borrowed
    /// \throws InputError  an index is out of range
    MeasuredParts(const Asset& source, const Options& options, Poll poll = {});

    const SceneSize& size() const { return size_; }
    /// Of all parts.
    std::uint64_t faces() const { return faces_; }
    /// In the units of the scene, the largest of all parts.
    Distance operator()(const SmallParts& small, double allowed, Look look, Poll poll) const;

private:
    const Options& options_;
    SceneSize size_;
    std::vector<Original> originals_;
    std::uint64_t faces_ = 0;
};

/// simplify_parts() with max_error: searches over the face count of the whole asset, one call of
/// simplify_parts() for each try.
/// \pre options are valid
SmallParts simplify_parts_within(const Asset& source, const Options& options);

}  // namespace faqem::detail
