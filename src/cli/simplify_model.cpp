#include "cli/simplify_model.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <sstream>

#include "faqem/error.hpp"
#include "cli/strict.hpp"

namespace faqem::tool {

Asset load_model(const std::filesystem::path& file, Strictness strictness) {
    Asset asset = load(file);
    std::uint64_t faces = 0;
    for (const Part& part : asset.parts) faces += part.triangles.size();
    if (faces == 0) throw InputError(file.string(), "", "has no triangles");
    if (strictness == Strictness::strict) require_clean(asset, file.string());
    return asset;
}

BakeOptions bake_for(BakeOptions asked, const Asset& source, const std::filesystem::path& out) {
    if (asked.kind != Bake::automatic) return asked;
    std::string ending = out.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto no_part_has = [&](auto values) {
        return std::all_of(source.parts.begin(), source.parts.end(),
                           [&](const Part& p) { return (p.*values).empty(); });
    };
    const bool bare = source.materials.empty() && no_part_has(&Part::colors);
    if (ending == ".stl") {
        asked.kind = Bake::none;
        // Nothing is asked of the original then. Where it has normals, save() says that STL has none.
        asked.normals = no_part_has(&Part::normals) ? Normals::none : Normals::flat;
    }
    if (ending == ".ply") asked.kind = bare ? Bake::none : Bake::vertex;
    if (ending == ".obj" && bare) asked.kind = Bake::none;
    return asked;
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
