#include "asset/io/file_names.hpp"

namespace faqem::detail {

std::string buffer_file_name(const std::string& stem) { return stem + ".bin"; }

std::string library_file_name(const std::string& stem) { return stem + ".mtl"; }

std::string image_file_name(const std::string& stem, std::size_t number, const std::string& extension) {
    return stem + "_" + std::to_string(number) + extension;
}

}  // namespace faqem::detail
