#pragma once
/// \file
/// Finds the files that models name, also by paths of another computer, and collects them.

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "asset/io/file.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

/// A file that a reference was found to mean.
struct FoundFile {
    std::filesystem::path file;  ///< canonical, inside the folder of the model
    std::string name;            ///< relative to this folder, with slashes
    bool is_as_named = true;     ///< false: the reference names another path
};

/// Resolves references of one model. Lists each folder once, so that files which
/// appear later may not be found.
class FileFinder {
public:
    /// \param folder  of the model; empty: the current directory
    explicit FileFinder(std::filesystem::path folder);

    const std::filesystem::path& folder() const { return folder_; }

    /// Finds the file that a reference names. Quotes around a ReferenceSyntax::file_name are removed. If there is no such file, or
    /// not in the folder of the model or below it, the longest end of the path is used that names a file
    /// relative to `subfolder` or to the folder of the model, also one with other letter case (A to Z):
    /// `C:\job\Wood.PNG` finds `wood.png`. Of names that differ in case only, an equal one is used, else the
    /// first in the order of bytes. A URI is searched percent-decoded, as written, and without query and fragment.
    /// \param reference  as written in a file in `subfolder`
    /// \param subfolder  relative to the folder of the model
    /// \throws InputError  no file was found: the error of resolve_inside() for the name as written
    FoundFile find(const std::string& reference, const std::filesystem::path& subfolder = {},
                   ReferenceSyntax syntax = ReferenceSyntax::file_name);

    /// Returns the names of the files in the folder of the model with an extension, in any case, sorted.
    /// \param extension  in lower case, with its dot
    std::vector<std::string> files_with_extension(const std::string& extension);

private:
    using Names = std::vector<std::string>;

    const Names& names_in(const std::filesystem::path& subfolder);
    FoundFile resolve(const std::filesystem::path& path, ReferenceSyntax syntax, bool is_as_named) const;
    std::optional<FoundFile> find_end(const Names& steps, const std::filesystem::path& subfolder);
    std::optional<std::filesystem::path> match(std::filesystem::path subfolder, const Names& steps,
                                               std::size_t first);

    std::filesystem::path folder_;
    std::map<std::filesystem::path, Names> names_;  // sorted, by folder
};

/// Which of the files that a model refers to.
enum class References {
    /// Those that load() may read: in the folder of the model or below it.
    readable,
    /// All, read or not and in any folder. Where a statement can be understood in several ways, the files of all of
    /// them.
    all
};

/// Whether load() may read a file.
enum class Readable { no, yes };

/// The existing files that references of a model name, each path once.
class ReferenceList {
public:
    ReferenceList(const std::filesystem::path& model, References which)
        : finder_(model.parent_path()), which_(which) {}

    /// Finds files that references of the model mean.
    FileFinder& finder() { return finder_; }

    /// Adds the file that a reference names if it exists, and if it is one of those that are wanted; and, if it may be
    /// read, the one that FileFinder finds.
    /// \param subfolder  of the file with the reference, relative to the folder of the model
    void add(const std::string& reference, ReferenceSyntax syntax, Readable readable,
             const std::filesystem::path& subfolder = {}) {
        std::filesystem::path named = referenced_path(finder_.folder() / subfolder, reference, syntax);
        std::error_code error;
        if (which_ == References::all && std::filesystem::is_regular_file(named, error) &&
            known_.insert(named).second) {
            canonical_.insert(std::filesystem::weakly_canonical(named, error));
            files_.push_back(std::move(named));
        }
        if (readable == Readable::no) return;
        try {
            add_found(finder_.find(reference, subfolder, syntax).file);
        } catch (const InputError&) {  // there is none
        }
    }

    /// Adds a file that may be read, unless it is already in the list under any path.
    /// \param file  canonical
    void add_found(const std::filesystem::path& file) {
        if (canonical_.insert(file).second && known_.insert(file).second) files_.push_back(file);
    }

    std::vector<std::filesystem::path> finish() { return std::move(files_); }

private:
    FileFinder finder_;
    References which_;
    std::vector<std::filesystem::path> files_;
    std::set<std::filesystem::path> known_, canonical_;
};

}  // namespace faqem::detail
