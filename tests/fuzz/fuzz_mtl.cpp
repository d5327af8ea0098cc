#include "asset/formats/mtl.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> warnings;
    const auto materials = fuzz::refusable(
        "a.mtl", [&] { return detail::read_mtl(fuzz::Bytes(data, size), "a.mtl", warnings); });
    if (!materials) return 0;
    Asset asset;
    for (const detail::MtlMaterial& material : *materials)
        detail::add_material(asset, material, "no-such-folder");
    fuzz::expect_sound(asset);
    return 0;
}
