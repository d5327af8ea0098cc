#pragma once
/// \file
/// Parts of a scene as cameras see them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asset/scene/affine.hpp"
#include "asset/scene/material_textures.hpp"
#include "render/camera.hpp"

namespace faqem::detail {

/// Meshes in world space with the sides from which viewers see them.
struct PlacedParts {
    /// Adds a mesh.
    /// \param triangles    must outlive this
    /// \param asset        has the materials
    /// \param material_of  gives the index of the material of a face
    template <class MaterialOf>
    void add(std::span<const Vec3> of_part, std::span<const Triangle> triangles,
             const std::array<double, 16>& transform, const Asset& asset, const MaterialOf& material_of) {
        std::vector<engine::Vector3>& own = positions.emplace_back();
        for (const Vec3& p : of_part) own.push_back(engine::to_eigen(transformed_point(transform, p)));
        // Viewers hide the back of single-sided faces.
        const std::int8_t front = NormalTransform(transform).is_mirrored() ? -1 : 1;
        std::vector<std::int8_t>& seen = sides.emplace_back();
        for (std::size_t f = 0; f < triangles.size(); ++f)
            seen.push_back(material_or_default(asset, material_of(f)).double_sided ? 0 : front);
        meshes.push_back({own, triangles, seen});
    }

    std::vector<std::vector<engine::Vector3>> positions;  ///< by mesh
    std::vector<std::vector<std::int8_t>> sides;          ///< by mesh
    std::vector<render::PlacedMesh> meshes;               ///< refer to the others
};

}  // namespace faqem::detail
