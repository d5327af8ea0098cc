#pragma once
/// \file
/// A temporary directory.

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "faqem/error.hpp"

namespace faqem::cli {

/// Creates a directory in the system's temporary directory, and deletes it with its contents at destruction.
class TemporaryFolder {
public:
    /// \param name  prefix of the directory's name
    /// \throws WriteError  the directory cannot be created
    explicit TemporaryFolder(const std::string& name) {
        std::string path = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
        if (mkdtemp(path.data()) == nullptr) throw WriteError(path + ": cannot create a temporary directory");
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
