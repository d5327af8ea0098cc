#pragma once
/// \file
/// Grids to which the positions of a result are rounded in glTF files, for Options::quantize.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/options.hpp"
#include "faqem/report.hpp"

namespace faqem::detail {

/// The grids of the parts of a result.
struct PositionGrids {
    std::vector<double> spacings;  ///< by part: Part::position_spacing; empty: all 0
    std::vector<double> scales;    ///< by part: the largest scale of its instances
    double spacing = 0;            ///< the largest of the grids in scene units
    /// Grids of the source are not used, since they are coarse for Options::max_error.
    bool is_left_out = false;

    /// Largest distance by which the rounding moves a point of the surface, scene units.
    double max_distance() const;
};

/// QuantizeOptions::position_bits if it is unset.
inline constexpr std::uint32_t usual_position_bits = 14;

/// Chooses the grids. With Quantize::on, or with Draco data unless Quantize::off is set, their spacing is the smallest
/// power of two in scene units that divides the diagonal of the scene into at most 2^position_bits steps: levels of
/// detail of a source have the same, and so has a result that is read and written again.
/// \param source   a valid asset
/// \param options  valid
/// Complexity: O(faces log faces)
PositionGrids position_grids(const Asset& source, const Options& options);

/// The compression of a result.
Compression result_compression(const Asset& source, const Options& options);

/// Sets the members of a result that save() rounds vertices by, and Report::position_rounding.
/// \param result  has a part for each of the source
/// Complexity: O(faces log faces + vertices of the result)
void set_quantization(const Asset& source, const Options& options, Asset& result, Report& report);

}  // namespace faqem::detail
