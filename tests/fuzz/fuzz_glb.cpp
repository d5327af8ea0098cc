// Complete GLB or JSON glTF files; tests mainly the GLB framing.

#include "asset/gltf/gltf.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto read = [](fuzz::Bytes bytes, const std::string& file) {
        return detail::read_gltf(bytes, file);
    };
    fuzz::read_sound({data, size}, read, "a.glb");
    return 0;
}
