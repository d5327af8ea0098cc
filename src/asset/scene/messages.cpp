#include "asset/scene/messages.hpp"

namespace faqem::detail {

std::string pluralized(std::uint64_t count, const std::string& noun) {
    if (count == 1) return "1 " + noun;
    const bool es = noun.ends_with('x') || noun.ends_with('s');
    return std::to_string(count) + " " + (noun == "vertex" ? "vertices" : noun + (es ? "es" : "s"));
}

void add_counted(std::vector<std::string>& warnings, std::uint64_t count, const std::string& noun,
                 const std::string& rest) {
    if (count > 0) warnings.push_back(pluralized(count, noun) + rest);
}

std::string bytes_text(std::uint64_t count) { return std::to_string(count) + " bytes"; }

std::vector<std::string> ignored_messages(const IgnoredStatements& ignored) {
    std::vector<std::string> messages;
    for (const auto& [name, count] : ignored)
        messages.push_back(name + ": " + pluralized(count, "statement"));
    return messages;
}

std::string material_title(const Asset& asset, Index material) {
    if (material == no_index) return "the default material";
    const std::string& name = asset.materials[material].name;
    return name.empty() ? "material " + std::to_string(material) : "material '" + name + "'";
}

std::string part_title(const Asset& asset, std::size_t part) {
    const std::string& name = asset.parts[part].name;
    return name.empty() ? "part " + std::to_string(part) : "part '" + name + "'";
}

}  // namespace faqem::detail
