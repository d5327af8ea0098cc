#include "asset/io/file_finder.hpp"

#include <algorithm>
#include <cstddef>

#include "faqem/detail/base/lower_case.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

std::string without_quotes(const std::string& name) {
    const bool is_quoted =
        name.size() > 2 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front();
    return is_quoted ? name.substr(1, name.size() - 2) : name;
}

/// The steps of a path after its root, its drive and the last step to a parent folder; the last ones of a long path.
std::vector<std::string> steps_of(const std::string& name) {
    constexpr std::size_t max_steps = 32;
    std::vector<std::string> steps;
    for (std::size_t first = 0; first <= name.size();) {
        const std::size_t end = std::min(name.find_first_of("/\\", first), name.size());
        const std::string step = name.substr(first, end - first);
        if (step == ".." || step.find('\0') != std::string::npos)
            steps.clear();
        else if (!step.empty() && step != "." && !(step.size() == 2 && step[1] == ':'))
            steps.push_back(step);
        first = end + 1;
    }
    if (steps.size() > max_steps) steps.erase(steps.begin(), steps.end() - max_steps);
    return steps;
}

}  // namespace

FileFinder::FileFinder(fs::path folder) : folder_(std::move(folder)) {}

FoundFile FileFinder::find(const std::string& reference, const fs::path& subfolder, ReferenceSyntax syntax) {
    const bool is_uri = syntax == ReferenceSyntax::uri;
    const std::string name = is_uri ? reference : without_quotes(reference);
    try {
        return resolve(subfolder / name, syntax, true);
    } catch (const InputError&) {
        std::vector<std::string> names = {name};
        if (is_uri)
            names = {percent_decoded(name), name, percent_decoded(name.substr(0, name.find_first_of("?#")))};
        for (const std::string& other : names)
            if (const std::optional<FoundFile> found = find_end(steps_of(other), subfolder)) return *found;
        throw;
    }
}

FoundFile FileFinder::resolve(const fs::path& path, ReferenceSyntax syntax, bool is_as_named) const {
    fs::path file = resolve_inside(folder_, path.string(), syntax);
    std::string name =
        file.lexically_relative(fs::canonical(folder_.empty() ? "." : folder_)).generic_string();
    return {std::move(file), std::move(name), is_as_named};
}

std::optional<FoundFile> FileFinder::find_end(const Names& steps, const fs::path& subfolder) {
    for (std::size_t first = 0; first < steps.size(); ++first) {
        for (const fs::path& start : {subfolder, fs::path()}) {
            const std::optional<fs::path> found = match(start, steps, first);
            if (!found) continue;
            try {
                return resolve(*found, ReferenceSyntax::file_name, false);
            } catch (const InputError&) {  // a folder, or a link to another folder
            }
        }
    }
    return std::nullopt;
}

std::vector<std::string> FileFinder::files_with_extension(const std::string& extension) {
    std::vector<std::string> files;
    for (const std::string& name : names_in({}))
        if (lower_case_extension(name) == extension) files.push_back(name);
    return files;
}

const FileFinder::Names& FileFinder::names_in(const fs::path& subfolder) {
    const auto [known, is_new] = names_.try_emplace(subfolder);
    if (!is_new) return known->second;
    std::error_code error;  // what cannot be listed has no files
    known->second = file_names(folder_ / subfolder, error);
    std::ranges::sort(known->second);
    return known->second;
}

std::optional<fs::path> FileFinder::match(fs::path subfolder, const Names& steps, std::size_t first) {
    for (std::size_t i = first; i < steps.size(); ++i) {
        const Names& names = names_in(subfolder);
        if (std::ranges::binary_search(names, steps[i])) {
            subfolder /= steps[i];
            continue;
        }
        const auto other = std::ranges::find_if(
            names, [&](const std::string& name) { return lower_case(name) == lower_case(steps[i]); });
        if (other == names.end()) return std::nullopt;
        subfolder /= *other;
    }
    return subfolder;
}

}  // namespace faqem::detail
