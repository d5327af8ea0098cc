// Runs a fuzz target without libFuzzer, over every file of the folders named, as `fuzz_NAME -runs=0
// FOLDER...` does with it.

#include <exception>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/fuzz.hpp"

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files_of(const fs::path& place) {
    if (!fs::is_directory(place)) return {place};
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(place)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

void run(const fs::path& file) {
    std::fprintf(stderr, "%s\n", file.c_str());
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("cannot be read");
    const std::vector<char> bytes(std::istreambuf_iterator<char>(in), {});
    // A copy of exactly its size: a read beyond the end is one beyond an allocation.
    const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
    LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

}  // namespace

int main(int count, char** arguments) try {
    std::size_t files = 0;
    for (const std::string argument : std::span(arguments, static_cast<std::size_t>(count)).subspan(1)) {
        if (argument[0] == '-') continue;  // libFuzzer's
        for (const fs::path& file : files_of(argument)) run(file), ++files;
    }
    std::printf("%zu inputs\n", files);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
