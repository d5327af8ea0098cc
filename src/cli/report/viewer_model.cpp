#include "cli/report/viewer_model.hpp"

#include <cmath>

#include "asset/file_format.hpp"

namespace faqem::cli {

std::vector<std::uint8_t> viewer_glb(const FlattenedModel& model, const ErrorSurface& error,
                                     const ViewerFrame& frame) {
    Asset asset;
    asset.images = model.asset.images;
    asset.materials = model.asset.materials;
    // `source` is an index into the source's glTF document, which is not part of this asset.
    for (Material& material : asset.materials) material.source = no_index;
    asset.parts = {model.flat, error.part};
    asset.parts[0].name = "look";
    asset.parts[1].uvs.resize(1);
    for (const double distance : error.distances)
        asset.parts[1].uvs[0].push_back({static_cast<float>(std::sqrt(distance / frame.max_distance)), 0});
    for (Part& part : asset.parts) {
        for (Vec3& p : part.positions)
            for (std::size_t k = 0; k < 3; ++k) p[k] = (p[k] - frame.centre[k]) / frame.unit;
        part.position_spacing = 0x1p-15;
        part.file_order = FileOrder::for_gpu;  // which takes few bytes
    }
    asset.compression = Compression::meshopt;
    const detail::EncodedModel encoded = detail::encode_model(asset, "viewer.glb");
    const std::span<const std::uint8_t> bytes = encoded.files.back().bytes;
    return {bytes.begin(), bytes.end()};
}

Asset color_by_distance(const ErrorSurface& error, double limit) {
    Asset asset;
    asset.parts = {error.part};
    for (const double distance : error.distances)
        asset.parts[0].colors.push_back(heat_color(limit > 0 ? distance / limit : 0));
    return asset;
}

}  // namespace faqem::cli
