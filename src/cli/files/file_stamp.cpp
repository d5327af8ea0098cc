#include "cli/files/file_stamp.hpp"

#include <sys/stat.h>

#include <cstdint>

namespace faqem::cli {

namespace fs = std::filesystem;

std::string modification_stamp(const std::vector<fs::path>& files) {
    std::string text;
    for (const fs::path& file : files) {
        struct stat status = {};
        if (::stat(file.c_str(), &status) != 0) continue;
        for (const auto number :
             {static_cast<std::int64_t>(status.st_size), static_cast<std::int64_t>(status.st_mtim.tv_sec),
              static_cast<std::int64_t>(status.st_mtim.tv_nsec)}) {
            if (!text.empty()) text += ' ';
            text += std::to_string(number);
        }
    }
    return text;
}

}  // namespace faqem::cli
