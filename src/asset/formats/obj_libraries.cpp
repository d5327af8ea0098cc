#include "asset/formats/obj_libraries.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "asset/io/file.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Returns the only library in the folder of a model, unless that has the name of another OBJ file there.
std::optional<std::string> renamed_library(const fs::path& model, FileFinder& finder) {
    const std::vector<std::string> all = finder.files_with_extension(library_file_name(""));
    if (all.size() != 1) return std::nullopt;
    const fs::path own = model.filename();
    for (const std::string& other : finder.files_with_extension(lower_case_extension(own)))
        if (fs::path(other) != own && fs::path(other).stem() == fs::path(all[0]).stem()) return std::nullopt;
    return all[0];
}

}  // namespace

std::vector<std::string> library_names(const std::string& statement, const fs::path& folder) {
    try {
        resolve_inside(folder, statement, ReferenceSyntax::file_name);
        return {statement};
    } catch (const InputError&) {
        std::vector<std::string> names;
        std::size_t first = 0;
        for (std::size_t end; (end = statement.find(".mtl ", first)) != std::string::npos; first = end + 5)
            names.push_back(statement.substr(first, end + 4 - first));
        names.push_back(statement.substr(first));
        return names;
    }
}

FoundFile find_library(const std::string& name, const fs::path& model, FileFinder& finder) {
    try {
        return finder.find(name);
    } catch (const InputError&) {
        const std::optional<std::string> other = renamed_library(model, finder);
        if (!other) throw;
        FoundFile found = finder.find(*other);
        found.is_as_named = false;
        return found;
    }
}

std::map<std::string, MtlMaterial> read_libraries(const std::vector<std::string>& statements,
                                                  const fs::path& model, FileFinder& finder,
                                                  std::vector<std::string>& warnings,
                                                  IgnoredStatements& ignored) {
    std::map<std::string, MtlMaterial> materials;
    std::set<std::string> known_names;
    std::set<fs::path> known_files;
    const auto read = [&](const std::string& name) {
        FoundFile found;
        std::vector<std::uint8_t> text;
        try {
            found = find_library(name, model, finder);
            if (!known_files.insert(found.file).second) return;
            text = read_file(found.file);
        } catch (const InputError& error) {
            warnings.push_back(std::string("material library ignored: ") + error.what());
            return;
        }
        if (!found.is_as_named)
            warnings.push_back("material library " + TextScanner::quoted(name) + " was not found; the file " +
                               TextScanner::quoted(found.name) + " is read");
        for (MtlMaterial& material : read_mtl(text, found.file.string(), warnings, ignored)) {
            material.folder = fs::path(found.name).parent_path();
            materials[material.values.name] = std::move(material);
        }
    };
    for (const std::string& statement : statements)
        for (const std::string& name : library_names(statement, finder.folder()))
            if (known_names.insert(name).second) read(name);
    return materials;
}

}  // namespace faqem::detail
