#include "model_grid.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace model {

namespace {

using faqem::Index;

constexpr int gutter = 4;

/// A chart with its rectangle in the texture.
struct PlacedChart {
    const Grid* grid;
    const Chart* chart;
    int x = 0, y = 0, width = 0, height = 0;  ///< texels, without the gutter
};

/// Packs charts on shelves, in the order of their height. \return false if they do not fit
bool pack(std::vector<PlacedChart>& charts, double scale, int size) {
    std::vector<std::size_t> order(charts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (PlacedChart& c : charts) {
        c.width = std::max(4, static_cast<int>(c.chart->width * scale));
        c.height = std::max(4, static_cast<int>(c.chart->height * scale));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return charts[a].height > charts[b].height; });
    int x = 0, y = 0, shelf = 0;
    for (const std::size_t i : order) {
        PlacedChart& c = charts[i];
        const int width = c.width + 2 * gutter, height = c.height + 2 * gutter;
        if (x + width > size) {
            y += shelf;
            x = shelf = 0;
        }
        if (x + width > size || y + height > size) return false;
        c.x = x + gutter;
        c.y = y + gutter;
        x += width;
        shelf = std::max(shelf, height);
    }
    return true;
}

/// Packs all charts at the largest scale that fits, to within half a percent.
std::vector<PlacedChart> place_charts(const std::vector<Grid>& grids, int size) {
    std::vector<PlacedChart> charts;
    for (const Grid& grid : grids) {
        for (const Chart& chart : grid.charts) charts.push_back({&grid, &chart});
    }
    double scale = size;
    while (!pack(charts, scale, size)) scale *= 0.995;
    return charts;
}

void paint(const PlacedChart& c, faqem::Pixels& texture) {
    constexpr int samples = 2;
    const Chart& chart = *c.chart;
    for (int y = -gutter; y < c.height + gutter; ++y) {
        for (int x = -gutter; x < c.width + gutter; ++x) {
            Vec3 sum = {};
            for (int k = 0; k < samples * samples; ++k) {
                const int column = k % samples, row = k / samples;
                const double u = std::clamp((x + (column + 0.5) / samples) / c.width, 0.0, 1.0);
                const double v = std::clamp((y + (row + 0.5) / samples) / c.height, 0.0, 1.0);
                const double s = chart.first_column + u * (chart.last_column - chart.first_column);
                const double t = chart.last_row + v * (chart.first_row - chart.last_row);
                sum = add(sum, c.grid->paint(s / c.grid->columns, t / c.grid->rows));
            }
            const std::size_t texel =
                static_cast<std::size_t>(c.y + y) * texture.width + static_cast<std::size_t>(c.x + x);
            for (std::size_t k = 0; k < 3; ++k) {
                const double value = std::clamp(sum[k] / (samples * samples), 0.0, 1.0);
                texture.rgba[4 * texel + k] = static_cast<std::uint8_t>(std::lround(value * 255));
            }
        }
    }
}

/// Diagonal that divides a cell into two triangles.
enum class Diagonal { shorter, rising, falling };

/// Adds the two triangles of a cell, except degenerate ones.
/// \param quad  lower left, lower right, upper right, upper left
void add_faces(faqem::Part& part, const std::array<Index, 4>& quad, Diagonal diagonal) {
    const auto p = [&](std::size_t k) -> const Vec3& { return part.positions[quad[k]]; };
    const auto length_squared = [&](std::size_t a, std::size_t b) {
        const Vec3 d = subtract(p(a), p(b));
        return dot(d, d);
    };
    const bool rising = diagonal == Diagonal::rising ||
                        (diagonal == Diagonal::shorter && length_squared(0, 2) <= length_squared(1, 3));
    const std::array<std::array<std::size_t, 3>, 2> triangles =
        rising ? std::array<std::array<std::size_t, 3>, 2>{{{0, 1, 2}, {0, 2, 3}}}
               : std::array<std::array<std::size_t, 3>, 2>{{{0, 1, 3}, {1, 2, 3}}};
    for (const auto& t : triangles) {
        if (p(t[0]) == p(t[1]) || p(t[1]) == p(t[2]) || p(t[2]) == p(t[0])) continue;  // degenerate at a pole
        part.triangles.push_back({quad[t[0]], quad[t[1]], quad[t[2]]});
    }
}

/// Returns the diagonal of a cell. In the corner cells of a grid, a diagonal that cuts off the corner would
/// join two boundary vertices; where two grids share their boundary, such an edge would have four faces.
Diagonal diagonal_of(const Grid& grid, int column, int row) {
    const bool left = column == 0, right = column + 1 == grid.columns;
    const bool bottom = row == 0, top = row + 1 == grid.rows;
    if ((left && bottom) || (right && top)) return Diagonal::rising;
    if ((right && bottom) || (left && top)) return Diagonal::falling;
    return Diagonal::shorter;
}

void add_chart(faqem::Part& part, const PlacedChart& c, std::uint32_t texture_size) {
    const Chart& chart = *c.chart;
    const auto first = static_cast<Index>(part.positions.size());
    const auto stride = static_cast<Index>(chart.last_column - chart.first_column + 1);
    for (int row = chart.first_row; row <= chart.last_row; ++row) {
        for (int column = chart.first_column; column <= chart.last_column; ++column) {
            // Files store floats: positions are rounded here, so that both sides of a seam remain equal.
            Vec3 p = c.grid->position(column, row);
            for (double& x : p) x = static_cast<float>(x);
            part.positions.push_back(p);
            const double u = double(column - chart.first_column) / (chart.last_column - chart.first_column);
            const double v = double(chart.last_row - row) / (chart.last_row - chart.first_row);
            part.uvs[0].push_back({static_cast<float>((c.x + u * c.width) / texture_size),
                                   static_cast<float>((c.y + v * c.height) / texture_size)});
        }
    }
    for (int row = chart.first_row; row < chart.last_row; ++row) {
        for (int column = chart.first_column; column < chart.last_column; ++column) {
            const Index v = first + static_cast<Index>(row - chart.first_row) * stride +
                            static_cast<Index>(column - chart.first_column);
            add_faces(part, {v, v + 1, v + stride + 1, v + stride}, diagonal_of(*c.grid, column, row));
        }
    }
}

/// Adds area-weighted vertex normals, averaged over the faces of all charts at a position.
void add_normals(faqem::Part& part) {
    std::map<Vec3, Vec3> sums;
    for (const faqem::Triangle& t : part.triangles) {
        const Vec3 &a = part.positions[t[0]], &b = part.positions[t[1]], &c = part.positions[t[2]];
        const Vec3 n = cross(subtract(b, a), subtract(c, a));
        for (const Vec3& p : {a, b, c}) sums[p] = add(sums[p], n);
    }
    for (const Vec3& p : part.positions) {
        const Vec3 n = unit(sums[p]);
        part.normals.push_back(
            {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
    }
}

}  // namespace

std::vector<Chart> split_into_charts(const Grid& grid, int across, int along, double width, double height) {
    std::vector<Chart> charts;
    for (int j = 0; j < along; ++j) {
        for (int i = 0; i < across; ++i) {
            charts.push_back({grid.columns * i / across, grid.columns * (i + 1) / across,
                              grid.rows * j / along, grid.rows * (j + 1) / along, width / across,
                              height / along});
        }
    }
    return charts;
}

faqem::Asset build(const std::vector<Grid>& grids, const std::string& name, std::uint32_t texture_size) {
    faqem::Pixels texture;
    texture.width = texture.height = texture_size;
    texture.rgba.assign(std::size_t{texture_size} * texture_size * 4, 255);
    faqem::Part part;
    part.name = name;
    part.uvs.resize(1);
    for (const PlacedChart& chart : place_charts(grids, static_cast<int>(texture_size))) {
        paint(chart, texture);
        add_chart(part, chart, texture_size);
    }
    part.face_material.assign(part.triangles.size(), 0);
    add_normals(part);

    faqem::Asset asset;
    faqem::Material material;
    material.name = name;
    material.base_color_texture.image = 0;
    material.metallic = 0;
    material.roughness = 0.55f;
    material.double_sided = true;  // the inside is visible through the open neck
    asset.materials.push_back(material);
    asset.images.push_back(faqem::encode_png(texture, name));
    asset.parts.push_back(std::move(part));
    return asset;
}

}  // namespace model
