#pragma once
/// \file
/// Rendering of several scenes from the same cameras, and composition of the frames to one image.

#include <cstdint>
#include <string>
#include <vector>

#include "render/rasterizer.hpp"

namespace faqem::render {

/// A row of the contact sheet: the views of one model.
struct ContactSheetRow {
    std::vector<Frame> frames;  ///< all of the same size
    std::string label;          ///< digits, commas, spaces and the letters of "faces"; others are not drawn
};

/// Composes rows of frames from top to bottom on a grey background, with labels at the lower left of each
/// row. The result is opaque sRGB.
/// \pre at least one row with at least one frame; all rows have the same number of frames of the same size
FAQEM_EXPORT Pixels compose_contact_sheet(const std::vector<ContactSheetRow>& rows);

/// Creates cameras around a scene. All cameras have the same distance, at which each of them sees the whole
/// scene.
/// \param scene  the scene
/// \param file   path of the scene, for error messages
/// \param views  number of cameras
/// \param z_up   the z axis points up, and not y
/// \throws InputError  if the scene has no triangles
FAQEM_EXPORT std::vector<Camera> cameras_around(const Scene& scene, const std::string& file,
                                                std::uint32_t views, bool z_up = false);

/// Renders each scene as a row of a contact sheet, with one view per camera and the number of faces as label.
/// The views are rendered in parallel.
/// \param scenes   the scenes, one per row
/// \param cameras  the cameras, one per column
/// \param size     width and height of a view in pixels
/// \param shading  whether lights are used
/// \param edges    whether edges are drawn
FAQEM_EXPORT std::vector<ContactSheetRow> draw_rows(const std::vector<Scene>& scenes,
                                                    const std::vector<Camera>& cameras, std::uint32_t size,
                                                    Shading shading, Edges edges);

/// Formats a number with thousands separators: `1,234,567`.
inline std::string with_commas(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
    return text;
}

}  // namespace faqem::render
