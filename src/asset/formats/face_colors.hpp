#pragma once
/// \file
/// Colours of faces as vertex colours.

#include <string>
#include <vector>

#include "asset/scene/triangulate.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Gives the corners of each polygon its colour. Vertices of polygons with different colours are repeated,
/// after all others.
/// \param part      vertices without colours
/// \param polygons  of the vertices of the part; changed to the repeated ones
/// \param colors    one per polygon, linear
/// \param file      path for messages
/// \throws InputError  there are more vertices than indices
void set_face_colors(Part& part, Polygons& polygons, const std::vector<Vec4f>& colors,
                     const std::string& file);

}  // namespace faqem::detail
