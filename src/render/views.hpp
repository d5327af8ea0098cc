#pragma once
/// \file
/// Pictures of several scenes from the same places.

#include <cstdint>
#include <string>
#include <vector>

#include "render/contact_sheet.hpp"
#include "render/rasteriser.hpp"

namespace faqem::render {

/// Cameras around a scene. All have the same distance, so that sizes can be compared, and the scene fits.
/// \param file  of the scene, for errors
/// \throws InputError  it has no triangles
std::vector<Camera> cameras_around(const Scene& scene, const std::string& file, std::uint32_t views);

/// Draws each scene in a row of a sheet, with a view for each camera and the number of faces for a label.
/// \param size  side of a view, pixels
std::vector<ContactSheetRow> draw_rows(const std::vector<Scene>& scenes, const std::vector<Camera>& cameras,
                                       std::uint32_t size, Shading shading, Edges edges);

/// `1,234,567`
std::string with_commas(std::uint64_t number);

}  // namespace faqem::render
