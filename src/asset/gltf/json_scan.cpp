#include "asset/gltf/json_scan.hpp"

#include <fstream>
#include <string_view>

namespace faqem::detail {

void scan_gltf(const std::filesystem::path& model, JsonScan& events) {
    // The JSON of a GLB file is its first chunk, after a file header of 12 bytes and a chunk header of 8 bytes.
    std::ifstream in(model, std::ios::binary);
    std::array<char, 20> head = {};
    const bool is_glb = in.read(head.data(), head.size()) && std::string_view(head.data(), 4) == "glTF";
    in.clear();
    if (!is_glb) in.seekg(0);
    constexpr bool strict = false;  // other chunks may follow
    static_cast<void>(Json::sax_parse(in, &events, Json::input_format_t::json, strict));
}

}  // namespace faqem::detail
