#include "asset/scene/measured_instances.hpp"

#include <algorithm>

namespace faqem::detail {
namespace {

constexpr std::uint64_t many_faces = std::uint64_t{1} << 24;
constexpr double many_copies = 4;

std::uint64_t face_count(const Asset& asset, const Instance& instance) {
    return asset.parts[instance.part].triangles.size();
}

}  // namespace

double shown_faces(const Asset& asset, const std::vector<Instance>& all) {
    double faces = 0;
    for (const Instance& instance : all) faces += static_cast<double>(face_count(asset, instance));
    return faces;
}

bool has_excessive_instances(const Asset& asset, const std::vector<Instance>& all) {
    const auto faces = static_cast<double>(face_count(asset));
    const double shown = shown_faces(asset, all);
    return shown > static_cast<double>(many_faces) && shown > many_copies * faces;
}

std::vector<std::size_t> measured_indices(const Asset& asset, const std::vector<Instance>& all) {
    std::vector<std::size_t> measured;
    const bool has_limit = has_excessive_instances(asset, all);
    std::vector<std::uint8_t> has_one(asset.parts.size(), 0);
    std::uint64_t faces = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Index part = all[i].part;
        const std::uint64_t own = face_count(asset, all[i]);
        if (has_limit && has_one[part] && own > many_faces - std::min(faces, many_faces)) continue;
        has_one[part] = 1;
        faces += own;
        measured.push_back(i);
    }
    return measured;
}

}  // namespace faqem::detail
