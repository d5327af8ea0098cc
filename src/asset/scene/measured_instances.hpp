#pragma once
/// \file
/// Scenes with so many instances that they cannot be copied one by one.

#include <cstddef>
#include <vector>

#include "asset/scene/part_arrays.hpp"
#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Number of faces that all instances show, which may be beyond the range of integers.
FAQEM_EXPORT double shown_faces(const Asset& asset, const std::vector<Instance>& all);

/// Whether a scene shows more than 2^24 faces, and more than four times those that its parts have.
FAQEM_EXPORT bool has_excessive_instances(const Asset& asset, const std::vector<Instance>& all);

/// Indices of the instances for measurements that copy all faces: all, but in a scene with has_excessive_instances() only
/// the first one of each part, and others in the order of the scene until 2^24 faces are reached.
/// Complexity: O(instances).
FAQEM_EXPORT std::vector<std::size_t> measured_indices(const Asset& asset, const std::vector<Instance>& all);

/// The instances at the measured_indices() of those of the scene.
inline std::vector<Instance> measured_instances(const Asset& asset) {
    const std::vector<Instance> all = instances(asset);
    return gather(all, measured_indices(asset, all));
}

}  // namespace faqem::detail
