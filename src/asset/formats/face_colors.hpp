#pragma once
/// \file
/// Colours of faces as vertex colours, and colours from 0 to 255.

#include <initializer_list>
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

/// Divides colours by 255, with a warning, if they were stored as numbers from 0 to 255. Numbers up to 2 are from 0 to
/// 1, possibly overexposed.
/// \param largest   number of a colour up to 255, as stored
/// \param colors    linear, as if the numbers were from 0 to 1
/// \param warnings  receives the warning
void divide_byte_colors(double largest, std::initializer_list<std::vector<Vec4f>*> colors,
                        std::vector<std::string>& warnings);

}  // namespace faqem::detail
