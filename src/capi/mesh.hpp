#pragma once
/// \file
/// The C door's meshes as views.

#include "faqem/faqem.h"
#include "faqem/mesh.hpp"

namespace faqem::capi {

/// A mesh of the C door. Only corner values are copied; indices and positions are checked by whoever gets the
/// view.
struct MeshArrays {
    /// \throws InputError  arrays that must be there are null, or there are more elements than indices can
    ///                     count
    explicit MeshArrays(const faqem_mesh& mesh);
    MeshArrays(const MeshArrays&) = delete;  // the view points into it
    MeshArrays& operator=(const MeshArrays&) = delete;

    CornerAttributes corners;
    MeshView view;
};

}  // namespace faqem::capi
