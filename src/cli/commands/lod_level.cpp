#include "cli/commands/lod_level.hpp"

#include <cmath>
#include <string_view>

#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

Level parse_level(const std::string& text, const ViewSettings& view_settings) {
    using detail::OptionKind;
    const auto parse = [](std::string_view number, OptionKind kind) {
        return detail::parse_option_number(number, kind, {.excludes_min = true}, "", "--levels");
    };
    constexpr std::string_view distance = "error:", pixels = "pixels:";
    if (text.starts_with(distance)) {
        const detail::OptionValue length = parse(text.substr(distance.size()), OptionKind::length);
        return Length{*length.number, length.unit};
    }
    if (text.starts_with(pixels)) {
        const std::string rest = text.substr(pixels.size());
        const std::size_t at = rest.find('@');
        if (at == std::string::npos)
            throw OptionError("--levels: '" + text + "' is not pixels:N@DISTANCE with two numbers");
        return model_units(error_from_pixels(*parse(rest.substr(0, at), OptionKind::number).number,
                                             *parse(rest.substr(at + 1), OptionKind::number).number,
                                             view_settings));
    }
    const double value = *parse(text, OptionKind::share).number;
    if (value <= 1) return ratio(value);
    if (!(!text.ends_with('%') && value < 1e15 && value == std::floor(value)))
        throw OptionError("--levels: '" + text + "' is neither a ratio in (0, 1] nor a number of faces");
    return faces(static_cast<std::uint64_t>(value));
}

}  // namespace faqem::cli
