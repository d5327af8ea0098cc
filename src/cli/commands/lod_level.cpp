#include "cli/commands/lod_level.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include "cli/options/simplify_options.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

/// Parses a positive finite number. Returns NaN if the text is anything else.
double parse_positive(std::string_view text) {
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && stop == text.data() + text.size();
    return whole && value > 0 && std::isfinite(value) ? value : std::nan("");
}

}  // namespace

Level parse_lod_level(const std::string& text, const ViewSettings& view_settings) {
    constexpr std::string_view kind = "pixels:";
    if (!text.starts_with(kind)) return parse_level(text);
    const std::string_view rest = std::string_view(text).substr(kind.size());
    const std::size_t at = rest.find('@');
    const double pixels = parse_positive(rest.substr(0, at)),
                 distance = at < rest.size() ? parse_positive(rest.substr(at + 1)) : std::nan("");
    if (!(pixels * distance > 0))
        throw OptionError("--levels: '" + text + "' is not pixels:N@DISTANCE with two positive numbers");
    return model_units(error_from_pixels(pixels, distance, view_settings));
}

}  // namespace faqem::cli
