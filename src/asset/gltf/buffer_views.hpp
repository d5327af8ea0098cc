#pragma once
/// \file
/// Bytes of the buffer views of a glTF document, for reports.

#include <vector>

#include "asset/gltf/json.hpp"
#include "faqem/report.hpp"

namespace faqem::detail {

/// Lists the buffer views of a document, without those of images, in their order.
/// Complexity: O(size of the document).
std::vector<ResultView> buffer_views(const Json& document);

}  // namespace faqem::detail
