#pragma once
/// \file
/// Grids of positions that are stored as integers (KHR_mesh_quantization), and the nodes, skins and instances that
/// restore their size.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/gltf/accessor.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

struct GltfWriter;

/// How the positions of an output mesh are stored. A position is spacing * (origin + k) for an integer k in the file.
struct MeshGrid {
    double spacing = 0;                       ///< units of the mesh; 0: positions are floats
    std::array<std::int64_t, 3> origin = {};  ///< in steps
    NumberType type = NumberType::f32;        ///< i8, u8, i16 or u16 if there is a spacing
    bool normalized = false;                  ///< the spacing is that of normalised integers

    bool is_on() const { return spacing > 0; }

    /// Whether k differs from the position, so that nodes, skins or instances must restore it.
    bool needs_transform() const {
        return is_on() && !normalized && (spacing != 1 || origin != std::array<std::int64_t, 3>{});
    }

    /// The position of k = 0.
    Vec3 offset() const;

    /// The nearest k; halves are rounded away from zero.
    std::int32_t step(float position, std::size_t axis) const;

    /// A displacement in steps.
    double steps(float displacement) const;
};

/// Chooses the grid of a mesh by Part::position_spacing. Without an origin if possible, so that most meshes of a scene
/// need the same scale and no translation.
/// \param parts   the parts of the mesh, by GltfWriter::asset
/// \param origin  subtracted from all positions
/// \param unfit   receives why positions are floats although the parts have a spacing
/// \return a grid that is_on() and holds all positions that triangles use, or floats
/// O(triangles)
MeshGrid choose_grid(const std::vector<const Part*>& parts, const Vec3& origin, std::string& unfit);

/// Whether a mesh needs nodes, skins or instances that restore its size.
bool any_needs_transform(const GltfWriter& writer);

/// Restores the sizes of all meshes in nodes, inverse bind matrices and instances. A node's own size, its children,
/// cameras, lights and animations do not change: if it has any, its mesh is moved to a new child.
/// \pre the scene is written, except for instances and inverse bind matrices, which are not copied if
///      any_needs_transform(): they refer to accessors of the source
void place_grids(GltfWriter& writer);

/// Moves the mesh of a node, with its skin, weights, instances and animation of weights, to a new child.
/// \return the child
Index move_mesh_to_child(GltfWriter& writer, Index node);

}  // namespace faqem::detail
