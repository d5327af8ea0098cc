#include "render/views.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/error.hpp"

namespace faqem::render {

namespace {

constexpr double first_azimuth = 0.35;
constexpr std::array<double, 2> elevations = {0.16, 0.42};  // radians: alternating low and higher views

using Eigen::Vector3f;

constexpr float top_grey = 0.80f, bottom_grey = 0.58f, text_grey = 0.035f;  // linear
constexpr std::uint32_t glyph_width = 5, glyph_height = 7;

/// A bitmap character of 5 x 7 dots. In each row, bit 4 is the leftmost dot.
struct Glyph {
    char character;
    std::array<std::uint8_t, glyph_height> rows;
};

constexpr std::array<Glyph, 17> font = {{
    {'0', {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e}},
    {'1', {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e}},
    {'2', {0x0e, 0x11, 0x01, 0x06, 0x08, 0x10, 0x1f}},
    {'3', {0x1f, 0x02, 0x04, 0x06, 0x01, 0x11, 0x0e}},
    {'4', {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02}},
    {'5', {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e}},
    {'6', {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e}},
    {'7', {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08}},
    {'8', {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e}},
    {'9', {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c}},
    {',', {0x00, 0x00, 0x00, 0x00, 0x0c, 0x04, 0x08}},
    {'f', {0x06, 0x08, 0x1e, 0x08, 0x08, 0x08, 0x08}},
    {'a', {0x00, 0x00, 0x0e, 0x01, 0x0f, 0x11, 0x0f}},
    {'c', {0x00, 0x00, 0x0e, 0x10, 0x10, 0x10, 0x0e}},
    {'e', {0x00, 0x00, 0x0e, 0x11, 0x1f, 0x10, 0x0e}},
    {'s', {0x00, 0x00, 0x0f, 0x10, 0x0e, 0x01, 0x1e}},
    {' ', {}},
}};

void set_pixel(Pixels& sheet, std::uint32_t x, std::uint32_t y, const Vector3f& color) {
    std::uint8_t* p = &sheet.rgba[(std::size_t{y} * sheet.width + x) * 4];
    for (int k = 0; k < 3; ++k) p[k] = detail::srgb_byte(color[k]);
    p[3] = 255;
}

void paste(Pixels& sheet, const Frame& frame, std::uint32_t left, std::uint32_t top) {
    for (std::uint32_t y = 0; y < frame.size; ++y) {
        const float t = static_cast<float>(y) / static_cast<float>(frame.size);
        const float grey = (1 - t) * top_grey + t * bottom_grey;
        for (std::uint32_t x = 0; x < frame.size; ++x) {
            const Eigen::Vector4f& c = frame.pixels[std::size_t{y} * frame.size + x];
            set_pixel(sheet, left + x, top + y, c.head<3>() + (1 - c[3]) * Vector3f::Constant(grey));
        }
    }
}

void draw_text(Pixels& sheet, const std::string& text, std::uint32_t left, std::uint32_t top,
               std::uint32_t dot_size) {
    for (const char character : text) {
        const auto* glyph = std::ranges::find(font, character, &Glyph::character);
        if (glyph == font.end()) continue;
        for (std::uint32_t y = 0; y < glyph_height * dot_size; ++y) {
            for (std::uint32_t x = 0; x < glyph_width * dot_size; ++x) {
                const bool set = glyph->rows[y / dot_size] >> (glyph_width - 1 - x / dot_size) & 1;
                if (set && left + x < sheet.width)
                    set_pixel(sheet, left + x, top + y, Vector3f::Constant(text_grey));
            }
        }
        left += (glyph_width + 1) * dot_size;
    }
}

}  // namespace

std::vector<Camera> cameras_around(const Scene& scene, const std::string& file, std::uint32_t views,
                                   bool z_up) {
    std::vector<Camera> result;
    for (std::uint32_t i = 0; i < views; ++i)
        result.push_back(orbit_camera(first_azimuth + 2 * std::numbers::pi * i / views,
                                      elevations[i % elevations.size()]));
    if (z_up)
        for (Camera& camera : result)
            for (Vector3* vector : {&camera.right, &camera.up, &camera.back})
                *vector = {vector->x(), -vector->z(), vector->y()};
    if (!show_all(placed_meshes(scene), result)) throw InputError(file, "", "has no triangles");
    return result;
}

std::vector<ContactSheetRow> draw_rows(const std::vector<Scene>& scenes, const std::vector<Camera>& cameras,
                                       std::uint32_t size, Shading shading, Edges edges) {
    std::vector<ContactSheetRow> rows(scenes.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        rows[r].frames.resize(cameras.size());
        rows[r].label = with_commas(scenes[r].faces) + " faces";
    }
    detail::parallel_blocks(scenes.size() * cameras.size(), 1, 0, [&](std::size_t i, std::size_t) {
        const std::size_t r = i / cameras.size(), v = i % cameras.size();
        rows[r].frames[v] = render(scenes[r], cameras[v], size, shading, edges);
    });
    return rows;
}

Pixels compose_contact_sheet(const std::vector<ContactSheetRow>& rows) {
    const std::uint32_t size = rows.at(0).frames.at(0).size;
    Pixels sheet;
    sheet.width = size * static_cast<std::uint32_t>(rows[0].frames.size());
    sheet.height = size * static_cast<std::uint32_t>(rows.size());
    sheet.rgba.resize(std::size_t{sheet.width} * sheet.height * 4);
    const std::uint32_t dot_size = std::max(1u, size / 240);
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        for (std::uint32_t c = 0; c < rows[r].frames.size(); ++c)
            paste(sheet, rows[r].frames[c], c * size, r * size);
        const std::uint32_t margin = 6 * dot_size;
        if (size > glyph_height * dot_size + 2 * margin)
            draw_text(sheet, rows[r].label, margin, r * size + size - margin - glyph_height * dot_size,
                      dot_size);
    }
    return sheet;
}

}  // namespace faqem::render
