#pragma once
/// \file
/// Collects the files that a model refers to.

#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "asset/io/file_finder.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

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
