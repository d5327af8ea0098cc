#include "cli/batch/plan.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <map>

#include "asset/file_format.hpp"
#include "asset/io/set_folder.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

bool is_model_name(const fs::path& file) {
    const detail::FileFormat* format = detail::format_by_name(file);
    return format && format->read;
}

/// Returns why a link leads to no file, or an empty string if the entry is no link or leads to one.
std::string link_problem(const fs::directory_entry& entry) {
    std::error_code error, no_target;
    if (!entry.is_symlink(error)) return {};
    const fs::file_status status = fs::status(entry.path(), error);
    if (fs::exists(status)) return {};
    const std::string target = fs::read_symlink(entry.path(), no_target).string();
    return "is a link to " + target + ": " +
           (status.type() == fs::file_type::not_found ? "No such file or directory" : error.message());
}

void search(const fs::path& folder, const fs::path& out_folder, std::vector<BatchFile>& found,
            std::size_t& others) {
    std::error_code error;
    for (auto it = fs::recursive_directory_iterator(folder); it != fs::recursive_directory_iterator(); ++it) {
        std::string problem = link_problem(*it);
        if (problem.empty() && it->is_directory() &&
            (fs::equivalent(it->path(), out_folder, error) ||
             it->path().filename() == detail::set_folder_name)) {
            it.disable_recursion_pending();
            continue;
        }
        if (problem.empty() && !it->is_regular_file()) continue;
        if (!is_model_name(it->path())) {
            ++others;
            continue;
        }
        found.push_back({.in = it->path(),
                         .name = it->path().lexically_relative(folder).generic_string(),
                         .bytes = problem.empty() ? it->file_size() : 0,
                         .problem = problem});
    }
}

void assign_output_paths(std::vector<BatchFile>& files, const fs::path& out_folder,
                         const std::string& extension) {
    std::map<std::string, const BatchFile*> output_names;
    for (BatchFile& file : files) {
        file.out_name = fs::path(file.name).replace_extension(extension).generic_string();
        file.out = out_folder / file.out_name;
        const auto [other, is_new] = output_names.emplace(file.out_name, &file);
        if (!is_new)
            throw OptionError(file.out.string() + ": two models have this output file: " +
                              other->second->in.string() + " and " + file.in.string());
    }
}

}  // namespace

std::string modification_stamp(const std::vector<fs::path>& files) {
    std::string text;
    for (const fs::path& file : files) {
        struct stat status = {};
        if (::stat(file.c_str(), &status) != 0) continue;
        text += (text.empty() ? "" : " ") + std::to_string(status.st_size) + " " +
                std::to_string(status.st_mtim.tv_sec) + " " + std::to_string(status.st_mtim.tv_nsec);
    }
    return text;
}

std::vector<BatchFile> find_models(const fs::path& folder, std::size_t& others, const fs::path& excluded) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw ReadError(folder.string(), "", "is not a directory");
    std::vector<BatchFile> files;
    try {
        others = 0;
        search(folder, excluded, files, others);
    } catch (const fs::filesystem_error& problem) {
        throw ReadError(problem.path1().empty() ? folder.string() : problem.path1().string(), "",
                        "cannot read: " + problem.code().message());
    }
    if (files.empty()) throw InputError(folder.string(), "", "contains no models");
    // Sorted, so that nothing depends on the order of the directory entries.
    std::ranges::sort(files, [](const BatchFile& a, const BatchFile& b) { return a.name < b.name; });
    return files;
}

std::vector<BatchFile> plan_batch(const fs::path& folder, const fs::path& out_folder,
                                  const std::string& extension, std::size_t& others) {
    std::error_code error;
    if (fs::equivalent(folder, out_folder, error))
        throw OptionError(out_folder.string() + ": is the input directory; choose another output directory");
    std::vector<BatchFile> files = find_models(folder, others, out_folder);
    assign_output_paths(files, out_folder, extension);
    std::ranges::stable_sort(files, [](const BatchFile& a, const BatchFile& b) { return a.bytes > b.bytes; });
    return files;
}

}  // namespace faqem::cli
