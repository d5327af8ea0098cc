#pragma once
/// \file
/// Surfaces given as grids, cut into UV charts, packed into one painted texture.

#include <functional>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "model_math.hpp"

namespace model {

/// A rectangle of a grid's cells that becomes one UV chart.
struct Chart {
    int first_column, last_column, first_row, last_row;  ///< grid lines
    double width, height;                                ///< roughly, in model units
};

/// A surface over columns x rows cells. Grid line `columns` may be the same place as line 0: `position` must
/// then return the same numbers.
struct Grid {
    int columns = 0, rows = 0;
    /// Position of a crossing of grid lines. Going right, then up is counter-clockwise seen from outside.
    std::function<Vec3(int column, int row)> position;
    /// sRGB colour in [0, 1] at (s, t) in [0, 1]^2.
    std::function<Vec3(double s, double t)> paint;
    std::vector<Chart> charts;
};

/// Cuts a grid into across x along charts of about equal size.
std::vector<Chart> cut(const Grid& grid, int across, int along, double width, double height);

/// All grids as one part with one material and one square texture.
/// \param texture_size  texels; charts are scaled alike until they fit, four texels of gutter about each
faqem::Asset build(const std::vector<Grid>& grids, const std::string& name, std::uint32_t texture_size);

}  // namespace model
