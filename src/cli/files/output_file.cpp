#include "cli/files/output_file.hpp"

#include <unistd.h>

#include <CLI/StringTools.hpp>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <set>
#include <span>

#include "asset/file_format.hpp"
#include "asset/io/file.hpp"
#include "asset/io/set_folder.hpp"
#include "asset/io/temporary_file.hpp"
#include "cli/files/protected_files.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/shown_text.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace fs = std::filesystem;

namespace {

/// Removes what dead processes left in a folder, once in a run: listing a folder for each of many results
/// would take quadratic time.
void clean_folder_once(const fs::path& folder) {
    static std::set<fs::path> cleaned;
    std::error_code error;
    const fs::path known = fs::canonical(folder, error);
    if (!error && cleaned.insert(known).second) detail::remove_leftovers(known);
}

/// Asks at a terminal, once for all files, whether those that exist may be overwritten. Files that are protected are not
/// asked about.
bool user_allows_overwriting(const std::vector<fs::path>& files) {
    if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0) return false;
    std::vector<fs::path> existing;
    for (const fs::path& file : std::set<fs::path>(files.begin(), files.end())) {
        std::error_code error;
        if (!fs::is_regular_file(file, error)) continue;
        check_unprotected(file);
        existing.push_back(file);
    }
    if (existing.empty()) return false;
    const auto changed = std::chrono::file_clock::to_sys(fs::last_write_time(existing[0]));
    const auto time = std::chrono::system_clock::to_time_t(std::chrono::floor<std::chrono::seconds>(changed));
    install_signal_handlers();
    const ExitOnInterrupt exit_on_interrupt;
    std::cerr << "faqem: " << existing[0].string() << " exists (" << shown_bytes(fs::file_size(existing[0]))
              << ", " << std::put_time(std::localtime(&time), "%Y-%m-%d %H:%M") << ")";
    if (existing.size() > 1) std::cerr << " and " << existing.size() - 1 << " more";
    std::cerr << "; overwrite? [y/N] " << std::flush;
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "Y" || answer == "yes";
}

/// Checks that two output files are not the same one, whether or not they exist. Links and relative paths do not matter.
void check_different(const fs::path& file, const fs::path& other) {
    std::error_code error;
    if (fs::weakly_canonical(fs::absolute(file)) == fs::weakly_canonical(fs::absolute(other)) ||
        fs::equivalent(file, other, error))
        throw OptionError(file.string() + ": is given for two files");
}

}  // namespace

void check_output(const fs::path& file, Overwrite overwrite, const std::string& advice) {
    std::error_code error;
    check_unprotected(file);
    if (const detail::FileFormat* format = detail::format_by_name(file);
        format && format->side_file.is_always_written)
        check_unprotected(file.parent_path() / format->side_file.name(file.stem().string()));
    const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
    if (!fs::is_directory(folder, error))
        throw WriteError(file.string() + ": no such directory: " + folder.string());
    detail::recover_folder(folder);
    clean_folder_once(folder);
    if (fs::is_directory(file, error)) throw WriteError(file.string() + ": is a directory");
    if (fs::exists(file, error) && !fs::is_regular_file(file, error))
        throw WriteError(file.string() + ": is not a regular file");
    if (overwrite == Overwrite::no && fs::exists(fs::symlink_status(file, error)))
        throw WriteError(file.string() + ": the file exists; " + advice);
#ifndef _WIN32
    if (access(folder.c_str(), W_OK) != 0)
        throw WriteError(file.string() + ": the directory is not writable");
#endif
}

Overwrite prepare_files(const std::vector<fs::path>& inputs, std::vector<fs::path> outputs, bool force) {
    for (const fs::path& input : inputs)
        if (!input.empty()) protect_input(input);
    std::erase(outputs, fs::path());
    const Overwrite overwrite = force || user_allows_overwriting(outputs) ? Overwrite::yes : Overwrite::no;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        check_output(outputs[i], overwrite);
        for (std::size_t k = 0; k < i; ++k) check_different(outputs[i], outputs[k]);
    }
    install_signal_handlers();
    return overwrite;
}

void check_extension(const fs::path& file, const std::vector<std::string_view>& extensions) {
    const std::string extension = detail::lower_case_extension(file);
    if (std::ranges::find(extensions, extension) != extensions.end()) return;
    throw OptionError(file.string() + ": the file name must end in one of " +
                      CLI::detail::join(extensions, ", "));
}

std::string format_names() {
    return CLI::detail::join(
        detail::format_extensions(detail::FormatUse::write),
        [](std::string_view extension) { return extension.substr(1); }, "|");
}

std::string default_format() { return format_names().substr(0, format_names().find('|')); }

ModelFormat format_of_output(const fs::path& file) {
    const detail::FileFormat* format = detail::format_by_name(file);
    return format ? format->format : ModelFormat::automatic;
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder, error))
        throw WriteError(folder.string() + ": cannot create the directory");
}

void write_output(const fs::path& file, std::string_view content, Overwrite overwrite) {
    detail::write_file(file, std::span(reinterpret_cast<const std::uint8_t*>(content.data()), content.size()),
                       overwrite);
}

void commit_outputs(detail::FileSet& set) {
    const ExitOnInterrupt exit_on_interrupt;
    set.commit(outputs_complete);
}

void write_together(const std::function<void()>& write) {
    const ExitOnInterrupt exit_on_interrupt;
    detail::FileSet set;
    {
        const detail::CollectWrites collect(set);
        write();
    }
    commit_outputs(set);
}

void write_only_output(const fs::path& file, std::string_view content, Overwrite overwrite) {
    write_together([&] { write_output(file, content, overwrite); });
}

}  // namespace faqem::cli
