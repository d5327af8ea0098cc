#pragma once
/// \file
/// The models that are embedded in the page for its 3D view and heat maps.

#include <cmath>
#include <cstdint>
#include <vector>

#include "cli/report/error_surface.hpp"
#include "cli/report/model_comparison.hpp"

namespace faqem::cli {

/// Coordinate frame of the 3D view. It normalizes positions to magnitudes near 1, because graphics hardware
/// computes in single precision.
struct ViewerFrame {
    Vec3 centre = {};         ///< origin of the frame, world space
    double unit = 1;          ///< length of its unit, model units, > 0
    double max_distance = 1;  ///< of both error surfaces, model units, > 0
};

/// Returns a GLB file with two meshes in the frame: `look` contains all instances of the model with its
/// materials, `error` the error surface with the root of the distance as a share of ViewerFrame::max_distance as
/// texture coordinate u. Positions are rounded to multiples of 2^-15, and geometry is compressed with meshoptimizer.
/// Skins and morph targets are in their pose at rest.
inline std::vector<std::uint8_t> viewer_glb(const FlattenedModel& model, const ErrorSurface& error,
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
    return to_glb(asset);
}

/// Returns the error surface with vertex colours by distance, for the rasterizer.
/// \param limit  distance at the end of the colour scale, model units
inline Asset color_by_distance(const ErrorSurface& error, double limit) {
    Asset asset;
    asset.parts = {error.part};
    for (const double distance : error.distances)
        asset.parts[0].colors.push_back(heat_color(limit > 0 ? distance / limit : 0));
    return asset;
}

}  // namespace faqem::cli
