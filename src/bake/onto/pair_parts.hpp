#pragma once
/// \file
/// Which parts of two scenes are the same thing.

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "asset/scene/part_arrays.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/vector.hpp"

namespace faqem::detail {

/// The boxes of instances of parts in world space.
struct BoxedParts {
    std::vector<std::string> names;
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<Index> of_face;  ///< the instance of each face of the flat scene
};

/// The names and boxes of the instances of a scene. O(faces)
/// \param asset      has the parts of the instances
/// \param instances  in the order of the faces of `flat`
/// \param flat       the scene as one part, in world space
template <class Instances>
BoxedParts boxed_parts(const Asset& asset, const Instances& instances, const Part& flat) {
    BoxedParts result;
    for (const auto& instance : instances) {
        const Part& part = asset.parts[instance.part];
        Eigen::AlignedBox3d& box = result.boxes.emplace_back();
        for (std::size_t f = 0; f < part.triangles.size(); ++f) {
            for (const Index v : flat.triangles[result.of_face.size()])
                box.extend(to_eigen(flat.positions[v]));
            result.of_face.push_back(static_cast<Index>(result.names.size()));
        }
        result.names.push_back(part.name);
    }
    return result;
}

/// By face: the number of the pair of its part, from 1 on; 0: it has none. A pair has one part of the target.
struct FacePairs {
    std::vector<Index> source, target;

    /// Whether a face of the target may show one of the source, which must not belong to another part of the target.
    bool show(Index target_face, Index source_face) const {
        if (target.empty() || target[target_face] == 0) return true;
        const Index other = source[source_face];
        return other == 0 || other == target[target_face];
    }
};

using Box = Eigen::AlignedBox3d;

inline constexpr double min_common_share = 0.5;

/// Share of the volume of two boxes that is common. Flat boxes count as thin ones.
inline double common_share(Box a, Box b) {
    const double margin = 1e-3 * a.merged(b).diagonal().norm();
    for (Box* box : {&a, &b}) *box = Box(box->min().array() - margin, box->max().array() + margin);
    const Box both = a.intersection(b);
    return both.isEmpty() ? 0 : both.volume() / (a.volume() + b.volume() - both.volume());
}

/// A part of the source belongs to the part of the target that has its name and a box that touches, otherwise to the one
/// whose box is most like its own, if they have more than half of their volume in common.
/// \return empty if one of the scenes has a single part
inline FacePairs pair_parts(const BoxedParts& source, const BoxedParts& target) {
    if (source.names.size() < 2 || target.names.size() < 2) return {};
    std::vector<Index> of_source(source.names.size(), 0), of_target(target.names.size(), 0);
    for (std::size_t s = 0; s < of_source.size(); ++s) {
        double best = min_common_share;
        for (std::size_t t = 0; t < of_target.size(); ++t) {
            double share = common_share(source.boxes[s], target.boxes[t]);
            if (share > 0 && !source.names[s].empty() && source.names[s] == target.names[t]) share += 1;
            if (!(share > best)) continue;
            best = share;
            of_source[s] = static_cast<Index>(t + 1);
        }
        if (of_source[s] != 0) of_target[of_source[s] - 1] = of_source[s];
    }
    return {gather(of_source, source.of_face), gather(of_target, target.of_face)};
}

}  // namespace faqem::detail
