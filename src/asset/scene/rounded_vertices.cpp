#include "asset/scene/rounded_vertices.hpp"

#include <cmath>
#include <cstdint>

namespace faqem::detail {
namespace {

// Bits of texture coordinates that meshopt compression rounds in any case.
constexpr std::uint32_t most_meshopt_uv_bits = 15;

// Bits of the compressed texture coordinates of a part; 0: exact.
std::uint32_t rounded_uv_bits(const Asset& asset, const Part& part) {
    switch (asset.compression) {
        case Compression::meshopt:
            if (part.file_order != FileOrder::for_gpu) return 0;
            return asset.uv_bits > 0 ? asset.uv_bits : most_meshopt_uv_bits;
        case Compression::draco:
            return asset.uv_bits;
        case Compression::source:
        case Compression::none:
            break;
    }
    return 0;
}

template <class Number>
Number rounded_to(Number value, double step) {
    return static_cast<Number>(std::round(double{value} / step) * step);
}

}  // namespace

bool round_vertices(Asset& asset) {
    bool is_rounded = false;
    for (Part& part : asset.parts) {
        if (part.position_spacing > 0) {
            is_rounded = true;
            for (Vec3& position : part.positions)
                for (double& x : position) x = rounded_to(x, part.position_spacing);
        }
        const std::uint32_t bits = rounded_uv_bits(asset, part);
        if (bits == 0) continue;
        const double step = std::ldexp(1.0, -static_cast<int>(bits));
        for (auto& uvs : part.uvs) {
            is_rounded = is_rounded || !uvs.empty();
            for (Vec2f& uv : uvs)
                for (float& x : uv) x = rounded_to(x, step);
        }
    }
    return is_rounded;
}

}  // namespace faqem::detail
