#include "tool/simplify_rules.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <sstream>

#include "faqem/error.hpp"
#include "tool/strict.hpp"

namespace faqem::tool {

Asset load_model(const std::filesystem::path& file, Strictness strictness) {
    Asset asset = load(file);
    std::uint64_t faces = 0;
    for (const Part& part : asset.parts) faces += part.triangles.size();
    if (faces == 0) throw InputError(file.string(), "", "has no triangles");
    if (strictness == Strictness::strict) require_clean(asset, file.string());
    return asset;
}

Bake bake_for(Bake kind, const Asset& source, const std::filesystem::path& out) {
    if (kind != Bake::automatic) return kind;
    std::string ending = out.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool bare = source.materials.empty() && std::all_of(source.parts.begin(), source.parts.end(),
                                                              [](const Part& p) { return p.colors.empty(); });
    if (ending == ".stl") return Bake::none;
    if (ending == ".ply") return bare ? Bake::none : Bake::vertex;
    return ending == ".obj" && bare ? Bake::none : kind;
}

LightAsset simplify_model(const Asset& source, const std::filesystem::path& file, const Options& options,
                          const std::optional<ByteBudget>& budget) {
    return naming(file, [&] {
        return budget ? simplify_within_bytes(source, options, *budget) : simplify(source, options);
    });
}

ExitCode why_refused(const Report& report, bool strict_target) {
    if (strict_target && report.faces_out > report.target_faces) return exit_target_missed;
    if (report.max_error && !report.max_error->within()) return exit_error_exceeded;
    return exit_ok;
}

std::string refusal_text(ExitCode refusal, const std::filesystem::path& out, const Report& report) {
    std::ostringstream text;
    if (refusal == exit_target_missed) {
        text << "target missed: " << report.faces_out << " faces, " << report.target_faces << " wanted; ";
    } else {
        text << "max error exceeded: " << report.faces_out << " faces are up to " << report.max_error->bound
             << " from the original, " << report.max_error->allowed << " allowed; ";
    }
    text << out.string() << " was not written";
    return text.str();
}

}  // namespace faqem::tool
