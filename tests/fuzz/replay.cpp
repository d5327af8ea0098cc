// Runs a fuzz target without libFuzzer on every file of the given folders, like `fuzz_NAME -runs=0 FOLDER...`
// with libFuzzer.

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
    if (!in) throw std::runtime_error("the file cannot be read");
    const std::vector<char> bytes(std::istreambuf_iterator<char>(in), {});
    // Copied to an allocation of exactly this size, so that AddressSanitizer finds reads beyond the end.
    const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
    LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

}  // namespace

int main(int count, char** arguments) try {
    std::size_t files = 0;
    for (const std::string argument : std::span(arguments, static_cast<std::size_t>(count)).subspan(1)) {
        if (argument[0] == '-') continue;  // option of libFuzzer
        for (const fs::path& file : files_of(argument)) run(file), ++files;
    }
    std::printf("%zu inputs\n", files);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
