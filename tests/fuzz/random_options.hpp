#pragma once
/// \file
/// Options from the bytes of a fuzz target.

#include <cmath>
#include <cstdint>

#include "faqem/options.hpp"
#include "fuzz/fuzz.hpp"

namespace faqem::fuzz {

/// Random options, sometimes out of range.
inline Options options_of(Input& in) {
    Options o;
    o.preset = all_presets[in.below(16) / 3];  // the last preset, which is slow, is rare
    const std::uint8_t wanted = in.byte();
    o.target = wanted < 128   ? ratio((wanted + 1) / 128.0)
               : wanted < 250 ? faces(wanted - 127)
                              : Target{wanted < 253 ? Target::Kind::ratio : Target::Kind::faces, in.real()};
    const std::uint8_t bits = in.byte(), more = in.byte();
    o.topology.link = static_cast<LinkCondition>(bits % 5);
    if (bits & 32) o.topology.weld = Weld::none;
    if (bits & 64) o.topology.virtual_edges = VirtualEdges::on, o.topology.virtual_edge_distance = 0.5;
    if (bits & 128) o.topology.boundary = Boundary::locked;
    if (more & 1) o.topology.group_boundaries = GroupBoundaries::preserved;
    if (more & 2) o.topology.weld_distance = std::abs(in.real());
    if (more & 4) o.topology.prune = of_diagonal(0.25);
    if (more & 16) o.visibility = Visibility::weighted;
    if (more & 8) {
        o.weights = {in.real(), in.real(), in.real(), in.real(), in.real()};
    }
    if (more % 64 >= 56) {  // rare, because it causes up to twelve runs
        o.max_error = Length{in.real() / 64, in.flag() ? Length::Unit::model : Length::Unit::diagonal};
        if (in.flag()) o.target = {};
    }
    o.history = Recording::on;
    o.threads = 1;
    return o;
}

}  // namespace faqem::fuzz
