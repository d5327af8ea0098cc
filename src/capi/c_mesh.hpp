#pragma once
/// \file
/// Conversion of the C API's meshes to views.

#include "faqem/faqem.h"
#include "faqem/mesh.hpp"

namespace faqem::capi {

/// View of a mesh of the C API. Only corner values are copied. Indices and values are not checked here.
struct MeshArrays {
    /// \throws InputError  a required array is null or given twice, has more elements than 32-bit indices can
    ///                     address, or has a layout in which numbers overlap
    explicit MeshArrays(const faqem_mesh& mesh);
    MeshArrays(const MeshArrays&) = delete;  // `view` refers to `corners`
    MeshArrays& operator=(const MeshArrays&) = delete;

    CornerAttributes corners;
    MeshView view;
};

}  // namespace faqem::capi
