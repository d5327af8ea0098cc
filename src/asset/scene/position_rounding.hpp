#pragma once
/// \file
/// How exactly files store positions, and rounding of the positions of results to that.

#include <optional>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// The rounding of the coordinates of a file.
class CoordinateRounding {
public:
    /// \param positions  finite
    /// Complexity: O(n)
    CoordinateRounding(const std::vector<Vec3>& positions, const StoredPrecision& stored);

    /// The largest difference of two coordinates that is taken for rounding: ten units in the last place of a float, or
    /// of a double if the coordinates are no floats, relative to the magnitude. In text of 6 to 15 digits, two in the
    /// last decimal place if that is more; with fewer, numbers are exact.
    /// \param magnitude  of the largest coordinates that take part in the rounding, >= 0
    double tolerance(double magnitude) const;

private:
    double relative_;
    std::optional<StoredPrecision> text_;
};

/// The precision in which a file of the format stores the positions of a result, in units of its parts.
/// \param format  of the result, known
/// \return `unknown` if the positions are not rounded: for glTF, which has other rules; for doubles; if the file has them
///     in other units, because of transforms; and if floats do not resolve them
/// Complexity: O(vertices of the source)
FAQEM_EXPORT StoredPrecision result_precision(const Asset& source, ModelFormat format);

/// Whether a format with floats loses digits of the source. \param positions  of the result, possibly rounded
bool loses_digits_as_floats(const StoredPrecision& stored, const std::vector<Vec3>& positions);

/// flatten() for a file. A scene of glTF has floats in the coordinates of the world, too, if these resolve them.
Part flatten_for_file(const Asset& asset);

/// Rounds positions to floats or to decimals: those of `precision`, or one more digit and decimal if it has fewer than six
/// digits. A corner of a face that this would leave without area moves by one step; if that does not help, or there are
/// more than a hundred such faces, nothing is rounded.
/// \param precision  as result_precision()
/// Complexity: O(n)
FAQEM_EXPORT void round_positions(const StoredPrecision& precision, const std::vector<Triangle>& triangles,
                                  std::vector<Vec3>& positions);

/// Rounds positions and texture coordinates as save() does in glTF files: by Part::position_spacing, and where geometry
/// is compressed by Asset::uv_bits. Normals and tangents stay exact, and texture coordinates of 16 bits.
/// \param asset  its parts stay valid; points may become equal
/// \return whether there is anything to round
/// Complexity: O(vertices).
FAQEM_EXPORT bool round_vertices(Asset& asset);

}  // namespace faqem::detail
