#pragma once
/// \file
/// A small software rasteriser for before-and-after pictures: depth buffer, perspective-correct attributes,
/// textures, two lights and a shadow in the corners.

#include <cstdint>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "render/texture.hpp"

namespace faqem::render {

using engine::Vector3;

/// An asset in world space with its images decoded.
struct Scene {
    struct PartInstance {
        Index part = no_index;
        std::vector<Vector3> positions;
        std::vector<Vector3> normals;  ///< unit or zero; empty: the faces' own
        bool mirrored = false;
    };
    Asset asset;
    std::vector<PartInstance> parts;
    std::vector<Texture> color_textures, normal_maps;  ///< by image; empty where not used so or not decodable
    std::uint64_t faces = 0;
    std::vector<std::string> warnings;
};

/// Decodes images that cannot be decoded as white, with a warning.
Scene make_scene(Asset asset);

struct Camera {
    Vector3 eye = Vector3::Zero();
    Vector3 right = Vector3::UnitX(), up = Vector3::UnitY(), back = Vector3::UnitZ();
    double tan_half_fov = 0.2;  ///< of half the field of view
};

/// The camera that looks at `centre` from a direction, at unit distance.
/// \param azimuth    about y, radians; 0: from +z
/// \param elevation  radians above the horizon
Camera orbit_camera(const Vector3& centre, double azimuth, double elevation);

/// Distance from `centre` at which a camera with these directions has the whole scene in the picture.
double fitting_distance(const Scene& scene, const Camera& camera, const Vector3& centre);

/// Box of the corners of all faces. False: there are none.
bool bounding_box(const Scene& scene, Vector3& low, Vector3& high);

enum class Shading { lit, unlit };
enum class Edges { hidden, drawn };

/// Square picture, premultiplied linear RGBA.
struct Frame {
    std::uint32_t size = 0;
    std::vector<Eigen::Vector4f> pixels;  ///< size * size
};

/// Draws a scene with 2 x 2 samples per pixel. Backs of faces are drawn too, as seen from their side.
Frame render(const Scene& scene, const Camera& camera, std::uint32_t size, Shading shading, Edges edges);

}  // namespace faqem::render
