#pragma once
/// \file
/// Surfaces given as grids, divided into UV charts that are packed into one painted texture.

#include <functional>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "model_math.hpp"

namespace model {

/// A rectangle of grid cells that forms one UV chart.
struct Chart {
    int first_column, last_column, first_row, last_row;  ///< grid lines
    double width, height;                                ///< approximate size, model units
};

/// A surface over columns x rows cells. If the surface is closed, `position` must return exactly the same
/// values for grid line `columns` as for line 0.
struct Grid {
    int columns = 0, rows = 0;
    /// Position of a grid point. Right, then up is counter-clockwise as seen from outside.
    std::function<Vec3(int column, int row)> position;
    /// sRGB colour in [0, 1] at (s, t) in [0, 1]^2.
    std::function<Vec3(double s, double t)> paint;
    std::vector<Chart> charts;
};

/// Divides a grid into across x along charts of about equal size.
/// \param width, height  size of the whole grid, model units
std::vector<Chart> split_into_charts(const Grid& grid, int across, int along, double width, double height);

/// Builds an asset of one part from all grids, with one material and one square texture.
/// \param texture_size  side of the texture in texels; the charts, each with a gutter of four texels, get the
///                      largest common scale that fits
faqem::Asset build(const std::vector<Grid>& grids, const std::string& name, std::uint32_t texture_size);

}  // namespace model
