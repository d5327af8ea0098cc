#pragma once
/// \file
/// Bytes of the buffer views of a glTF file, for reports.

#include <filesystem>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/report.hpp"

namespace faqem::detail {

/// Lists the buffer views of a file that write_gltf() has written, without those of images, in their order.
/// \param file  a .glb, or the JSON of a .gltf; under any name
/// \throws InputError if the file cannot be read
/// Complexity: O(size of the file).
FAQEM_EXPORT std::vector<ResultView> buffer_views(const std::filesystem::path& file);

}  // namespace faqem::detail
