// Complete files of the format FAQEM_FUZZ_FORMAT. The target glb, complete GLB or JSON glTF files, tests mainly the GLB
// framing.

#include "asset/formats/formats.hpp"
#include "asset/gltf/gltf.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;

namespace {

Asset read_model(fuzz::Bytes bytes, const std::string& file) {
    const std::string_view format = FAQEM_FUZZ_FORMAT;
    if (format == "obj") return detail::read_obj(bytes, file);
    if (format == "off") return detail::read_off(bytes, file);
    if (format == "ply") return detail::read_ply(bytes, file);
    if (format == "stl") return detail::read_stl(bytes, file);
    return detail::read_gltf(bytes, file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string format = FAQEM_FUZZ_FORMAT;
    fuzz::read_sound({data, size}, read_model, "a." + (format == "off" ? "ply" : format));  // OFF is not written
    return 0;
}
