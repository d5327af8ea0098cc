#include "cli/options/builtin_profiles.hpp"

#include <CLI/StringTools.hpp>
#include <algorithm>
#include <array>

#include "cli/process/json.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

using ProfileEntry = std::pair<std::string_view, std::string_view>;

constexpr std::array<ProfileEntry, 4> web_options = {
    {{"image-format", "webp"}, {"image-quality", "34"}, {"compress", "meshopt"}, {"quantize", "on"}}};

constexpr std::array<ProfileEntry, 3> game_options = {
    {{"image-format", "png-or-jpeg"}, {"compress", "none"}, {"quantize", "off"}}};

constexpr std::array<BuiltinProfile, 2> all_profiles = {
    {{"web",
      "the fewest bytes for web viewers that know EXT_texture_webp, EXT_meshopt_compression and "
      "KHR_mesh_quantization",
      web_options},
     {"game", "files that every importer of glTF reads: PNG and JPEG images, and geometry without extensions",
      game_options}}};

std::string names(const std::string& separator) {
    return CLI::detail::join(
        all_profiles, [](const BuiltinProfile& profile) { return profile.name; }, separator);
}

}  // namespace

std::span<const BuiltinProfile> builtin_profiles() { return all_profiles; }

const BuiltinProfile& builtin_profile(std::string_view name) {
    const auto found = std::ranges::find(all_profiles, name, &BuiltinProfile::name);
    if (found != all_profiles.end()) return *found;
    throw OptionError("--profile: unknown value '" + std::string(name) + "' (known: " + names(", ") +
                      "); --config reads a profile from a file");
}

OptionInfo builtin_profile_option() {
    OptionInfo info{
        {"--profile"},
        names("|"),
        "Options for web viewers or game engines; faqem profiles shows them. Those typed and those of "
        "--config take precedence",
        detail::OptionKind::choice};
    info.read = [](const std::vector<std::string>& values, bool) { builtin_profile(values.back()); };
    return info;
}

std::string profile_file(const BuiltinProfile& profile) {
    Json json = {{"faqem-profile", 1}};
    for (const auto& [key, value] : profile.options) json[std::string(key)] = value;
    return json.dump(2) + "\n";
}

std::string profile_list() {
    std::string text;
    for (const BuiltinProfile& profile : all_profiles) {
        text.append(profile.name).append(": ").append(profile.purpose).append("\n ");
        for (const auto& [key, value] : profile.options)
            text.append(" --").append(key).append("=").append(value);
        text.append("\n");
    }
    return text;
}

}  // namespace faqem::cli
