#pragma once
/// \file
/// A simple software rasterizer: depth buffer, perspective-correct attributes, textures and two lights.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"
#include "render/camera.hpp"
#include "render/texture_sampling.hpp"

namespace faqem::render {

/// An image as one role of a material shows it, or null.
using Texture = std::shared_ptr<const detail::MipImage>;

/// An asset in world space with decoded images.
struct Scene {
    /// An instance of a part in world space.
    struct PartInstance {
        Index part = no_index;  ///< index into Asset::parts
        std::vector<Vector3> positions;
        std::vector<Vector3> normals;  ///< unit or zero; empty: face normals are used
        bool mirrored = false;         ///< the transform reverses the orientation
    };
    Asset asset;  ///< posed parts follow those of the file
    std::vector<PartInstance> parts;
    std::vector<Texture> color_textures, normal_maps;  ///< by image; null if unused or not decodable
    std::uint64_t faces = 0;                           ///< number of faces of all instances
    std::vector<std::string> warnings;
};

/// Transforms an asset to world space, in its pose at rest, and decodes its images. An image that cannot be decoded is
/// drawn white, with a warning in Scene::warnings.
FAQEM_EXPORT Scene make_scene(Asset asset);

/// The meshes of all instances. They refer to the scene.
std::vector<PlacedMesh> placed_meshes(const Scene& scene);

/// How surfaces are drawn.
enum class Shading {
    lit,
    unlit,  ///< the base colour
};

/// Whether the edges of the triangles are drawn.
enum class Edges { hidden, drawn };

/// Whether the backs of faces with single-sided materials are drawn. Viewers hide them.
enum class Backs { drawn, hidden };

/// A square image in premultiplied linear RGBA.
struct Frame {
    std::uint32_t size = 0;               ///< width and height in pixels
    std::vector<Eigen::Vector4f> pixels;  ///< size * size, row 0 at the top
    /// By pixel: material of the nearest surface at its first sample, an index into Asset::materials or their number
    /// for the default material; no_index without a surface.
    std::vector<Index> materials;
};

/// Renders a scene with 2 x 2 samples per pixel. The backs of faces are drawn with flipped normals.
/// \param scene    the scene, borrowed
/// \param camera   the camera
/// \param size     width and height of the image in pixels
/// \param shading  whether lights are used
/// \param edges    whether edges are drawn
/// \param backs    whether single-sided faces are drawn from both sides
/// \return the image; pixels without a surface are transparent
Frame render(const Scene& scene, const Camera& camera, std::uint32_t size, Shading shading, Edges edges,
             Backs backs = Backs::drawn);

}  // namespace faqem::render
