#pragma once
/// \file
/// A folder for files that nobody is meant to keep.

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "faqem/error.hpp"

namespace faqem::cli {

/// A new folder among the system's temporary ones, gone afterwards with all that is in it.
class TemporaryFolder {
public:
    /// \param name  begins with it.
    /// \throws WriteError  it cannot be made
    explicit TemporaryFolder(const std::string& name) {
        std::string path = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
        if (mkdtemp(path.data()) == nullptr) throw WriteError(path + ": cannot be made");
        path_ = path;
    }
    ~TemporaryFolder() {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace faqem::cli
