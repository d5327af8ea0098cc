#include "cli/commands/lod_level.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include "faqem/error.hpp"
#include "cli/options/simplify_options.hpp"

namespace faqem::tool {

namespace {

/// Positive and finite, or not a number.
double positive(std::string_view text) {
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && stop == text.data() + text.size();
    return whole && value > 0 && std::isfinite(value) ? value : std::nan("");
}

}  // namespace

Level lod_level(const std::string& text, const Viewing& viewing) {
    constexpr std::string_view kind = "pixels:";
    if (!text.starts_with(kind)) return level_of(text);
    const std::string_view rest = std::string_view(text).substr(kind.size());
    const std::size_t at = rest.find('@');
    const double pixels = positive(rest.substr(0, at)),
                 distance = at < rest.size() ? positive(rest.substr(at + 1)) : std::nan("");
    if (!(pixels * distance > 0))
        throw OptionError("--levels: '" + text + "' is not pixels:N@DISTANCE with two positive numbers");
    return model_units(error_of_pixels(pixels, distance, viewing));
}

}  // namespace faqem::tool
