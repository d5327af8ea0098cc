#pragma once
/// \file
/// Values as text for people.

#include <cstdint>
#include <string>

namespace faqem::cli {

/// A number with a few significant digits; infinity for what is not finite.
std::string shown_number(double value, int digits = 4);
/// A share in percent, with three digits.
std::string shown_percent(double share);
/// `812 bytes`, `1.2 kB`, `34.5 MB`.
std::string shown_bytes(std::uint64_t bytes);

/// In which size a distance is less than a pixel, as the end of a sentence; empty if the distance is 0.
std::string shown_in_pixels(double distance, double diagonal);

}  // namespace faqem::cli
