#include "asset/formats/mtl.hpp"
#include "asset/formats/referenced_images.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> warnings;
    detail::IgnoredStatements ignored;
    const auto materials = fuzz::refusable(
        "a.mtl", [&] { return detail::read_mtl(fuzz::Bytes(data, size), "a.mtl", warnings, ignored); });
    if (!materials) return 0;
    Asset asset;
    detail::FileFinder finder("no-such-folder");
    detail::ReferencedImages images(asset, finder);
    for (const detail::MtlMaterial& material : *materials) detail::add_mtl_material(asset, images, material);
    fuzz::expect_sound(asset);
    return 0;
}
