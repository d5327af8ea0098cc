#pragma once
/// \file
/// Procedural shapes with the defects of real models.

#include <cstdint>
#include <string>

#include "faqem/mesh.hpp"

namespace faqem::soak {

/// A generated mesh with defects.
struct DirtyMesh {
    TriangleMesh mesh;
    std::string description;  ///< the shape and its defects
    bool is_invalid =
        false;  ///< simplify() must refuse the mesh: an index out of range, a position that is not finite
};

/// Creates a shape with up to four defects. It has some hundred to some thousand faces; one mesh in 1000 has
/// more than ten thousand. One mesh in 25 is invalid. The result depends only on `number`, not on the
/// compiler.
DirtyMesh dirty_mesh(std::uint32_t number);

}  // namespace faqem::soak
