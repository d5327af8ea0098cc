#include "cli/process/shown_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace faqem::cli {

std::string shown_number(double value, int digits) {
    if (!std::isfinite(value)) return "∞";
    std::array<char, 64> text;
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
    return {text.data(), end};
}

std::string shown_percent(double share) { return shown_number(100 * share, 3) + "%"; }

std::string shown_bytes(std::uint64_t bytes) {
    if (bytes < 1000) return std::to_string(bytes) + " bytes";
    const bool is_small = bytes < 999'950;
    std::ostringstream out;
    out << std::fixed << std::setprecision(1) << static_cast<double>(bytes) / (is_small ? 1e3 : 1e6);
    return out.str() + (is_small ? " kB" : " MB");
}

std::string shown_in_pixels(double distance, double diagonal) {
    if (!(distance > 0)) return {};
    return ": less than a pixel where the diagonal has up to " +
           std::to_string(std::llround(std::min(diagonal / distance, 1e15))) + " pixels";
}

}  // namespace faqem::cli
