#include "asset/gltf/source_document.hpp"

#include <algorithm>

namespace faqem::detail {

bool is_dynamic(const Asset& asset) {
    if (asset.source && !member(asset.source->document, "animations").empty()) return true;
    return std::any_of(asset.parts.begin(), asset.parts.end(),
                       [](const Part& part) { return !part.joints.empty() || !part.morph_targets.empty(); });
}

}  // namespace faqem::detail
