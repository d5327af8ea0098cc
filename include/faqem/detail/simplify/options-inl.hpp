#pragma once

#include "faqem/export.hpp"
#include "faqem/options.hpp"

#include <bit>
#include <cmath>
#include <string>

#include "faqem/error.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

inline void require(bool good, const char* what) {
    if (!good) throw OptionError(what);
}

inline void require_weight(const std::optional<double>& weight, const char* name) {
    if (weight && !(*weight >= 0 && std::isfinite(*weight))) {
        throw OptionError(std::string("weights.") + name + " must be finite and >= 0");
    }
}

}  // namespace detail

FAQEM_INLINE void validate(const Options& options) {
    const Target& target = options.target;
    if (target.kind == Target::Kind::faces) {
        detail::require(target.value >= 1 && std::isfinite(target.value), "target face count must be >= 1");
    } else {
        detail::require(target.value > 0 && target.value <= 1, "target ratio must be in (0, 1]");
    }
    if (options.max_error) {
        detail::require(options.max_error->value > 0 && std::isfinite(options.max_error->value),
                        "max_error must be finite and > 0");
    }
    detail::require(
        options.visibility == Visibility::ignored || !options.max_error ||
            options.target.kind != Target::Kind::unset,
        "visibility must be ignored if max_error is given without a target: distances are not weighted");
    detail::require_weight(options.weights.area, "area");
    detail::require_weight(options.weights.boundary, "boundary");
    detail::require_weight(options.weights.normal, "normal");
    detail::require_weight(options.weights.uv, "uv");
    detail::require_weight(options.weights.plane_area, "plane_area");
    const Topology& topology = options.topology;
    if (topology.weld_distance) {
        detail::require(*topology.weld_distance >= 0 && std::isfinite(*topology.weld_distance),
                        "weld_distance must be finite and >= 0");
    }
    detail::require(topology.virtual_edge_distance > 0 && topology.virtual_edge_distance <= 1,
                    "virtual_edge_distance must be in (0, 1]");
    if (topology.prune) {
        detail::require(topology.prune->value > 0 && std::isfinite(topology.prune->value),
                        "prune must be finite and > 0");
    }
    const BakeOptions& bake = options.bake;
    detail::require(
        std::has_single_bit(bake.texture_size) && bake.texture_size >= 64 && bake.texture_size <= 16384,
        "texture_size must be a power of two in [64, 16384]");
    detail::require(!bake.texel_density || (*bake.texel_density >= 0.125 && *bake.texel_density <= 8),
                    "texel_density must be in [0.125, 8]");
    detail::require(bake.samples >= 1 && bake.samples <= 8, "samples must be in [1, 8]");
    detail::require(bake.jpeg_quality >= 1 && bake.jpeg_quality <= 100, "jpeg_quality must be in [1, 100]");
    detail::require(bake.normals != Normals::none || bake.kind == Bake::none,
                    "normals may be none only if bake is none");
    detail::require(bake.crease_angle >= 0 && bake.crease_angle <= 180,
                    "crease_angle must be in [0, 180] degrees");
}

FAQEM_NAMESPACE_END
