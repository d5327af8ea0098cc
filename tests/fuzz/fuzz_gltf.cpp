// Input: JSON, a zero byte, and the BIN chunk. The GLB framing is added and always valid, so that the
// contents are tested.

#include "asset/gltf/container.hpp"
#include "asset/gltf/gltf.hpp"
#include "faqem/bake.hpp"
#include "faqem/simplify.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;

namespace {

Asset read_framed(fuzz::Bytes bytes, const std::string& file) {
    const auto end = std::find(bytes.begin(), bytes.end(), std::uint8_t{0});
    const auto json_size = static_cast<std::size_t>(end - bytes.begin());
    const std::string_view json(reinterpret_cast<const char*>(bytes.data()), json_size);
    const fuzz::Bytes bin = bytes.subspan(std::min(json_size + 1, bytes.size()));
    return detail::read_gltf(detail::join_glb(json, bin, file), file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::optional<Asset> asset = fuzz::read_sound({data, size}, read_framed, "a.glb");
    if (!asset || fuzz::face_count(*asset) == 0 || fuzz::face_count(*asset) > 64) return 0;
    fuzz::written_and_read(*asset, "a.ply");
    // Simplification that keeps UVs, skins and morph targets.
    Options options{.target = ratio(0.5), .bake = {.kind = Bake::keep}, .threads = 1};
    const auto simplified = fuzz::refusable("", [&] { return simplify(*asset, options); });
    if (simplified) fuzz::written_and_read(simplified->asset, "b.glb");
    return 0;
}
