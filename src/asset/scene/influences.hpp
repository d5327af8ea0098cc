#pragma once
/// \file
/// Joint influences of a vertex, of which a part stores four.

#include <array>
#include <cstdint>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// The influences of a vertex: each joint once, with the sum of its weights.
class FAQEM_EXPORT Influences {
public:
    /// Adds a weight to that of a joint. Weights that are not above 0 are ignored.
    void add(std::uint16_t joint, double weight);

    /// Sets the four joints with the largest weights, of equal ones the lower joints, in descending order of weight; the
    /// weights are scaled to the sum 1. Unused entries, and all if there is no influence, are 0. Removes all influences.
    /// \return the share of the weights that was left out, in [0, 1)
    double take_heaviest(std::array<std::uint16_t, 4>& joints, Vec4f& weights);

private:
    struct Influence {
        std::uint16_t joint;
        double weight;
    };
    std::vector<Influence> all_;
};

}  // namespace faqem::detail
