#pragma once
/// \file
/// The C door's meshes as views.

#include "faqem/faqem.h"
#include "faqem/mesh.hpp"

namespace faqem::c {

/// Nothing is copied. Indices and positions are checked by whoever gets the view.
/// \throws InputError  arrays that must be there are null, or there are more elements than indices can count
MeshView view_of(const faqem_mesh& mesh);

}  // namespace faqem::c
