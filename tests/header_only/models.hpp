#pragma once
/// \file
/// Generated meshes for the comparison of the build modes.

#include <faqem/mesh.hpp>

namespace models {

/// n x n squares over [0, 1]^2 on a surface of smooth waves.
faqem::TriangleMesh wavy_grid(faqem::Index n);

/// A tube with open ends, n faces around and m along.
faqem::TriangleMesh open_tube(faqem::Index n, faqem::Index m);

/// n x n squares, each with a fin on its diagonal: edges of three faces, and boundaries.
faqem::TriangleMesh fins(faqem::Index n);

}  // namespace models
