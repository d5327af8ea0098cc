#pragma once
/// \file
/// How exactly a file stores coordinates, told from their values.

#include <optional>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// The rounding of coordinates that were read from a file. They are
/// * floats, if all are: files with binary floats;
/// * decimals, if most have at most 15 digits, and at least one has six: text. These are also floats if each is what a
///   program prints for a float;
/// * floats, if no decimal has six digits: such numbers are exact;
/// * doubles otherwise.
class CoordinatePrecision {
public:
    /// \param positions  finite; if there are many, decimals are told from about 16,000 of them
    /// Complexity: O(n)
    explicit CoordinatePrecision(const std::vector<Vec3>& positions);

    /// The largest difference of two coordinates that is taken for rounding: ten units in the last place of the type,
    /// relative to the magnitude, or two in the last decimal place, whichever is larger.
    /// \param magnitude  of the largest coordinates that take part in the rounding, >= 0
    double tolerance(double magnitude) const;

    /// Whether the coordinates are floats, as numbers or as text.
    bool is_float() const { return is_float_; }

private:
    // Significant digits, and the exponent of the last decimal place.
    struct Decimals {
        int digits, last_place;
    };
    static Decimals decimals(double x);
    double decimal_unit(double magnitude) const;
    bool is_printed_float(double x) const;

    bool is_float_ = true;
    std::optional<Decimals> printed_;  // the most digits and the smallest last place of all numbers
};

}  // namespace faqem::detail
