#pragma once
/// \file
/// Procedural shapes, damaged in the ways that real models are.

#include <cstdint>
#include <string>

#include "faqem/mesh.hpp"

namespace faqem::soak {

struct DirtyMesh {
    TriangleMesh mesh;
    std::string story;  ///< the shape and what was done to it
    bool is_wrong =
        false;  ///< simplify() has to refuse it: an index out of range, a position that is no number
};

/// A shape of some hundred to some thousand faces, one in 1000 of some ten thousand and more, with up to four
/// kinds of damage; one in 25 is wrong. The same for the same number with every compiler.
DirtyMesh dirty_mesh(std::uint32_t number);

}  // namespace faqem::soak
