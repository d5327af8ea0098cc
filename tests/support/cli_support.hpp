#pragma once
/// \file
/// Runs the faqem command in a temporary folder, and creates small models for it.

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support/catch.hpp"
#include "support/cli_paths.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace tool_test {

namespace fs = std::filesystem;

using Folder = faqem::testing::TemporaryFolder;

inline std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// Exit code (-1 if ended by a signal) and output of a command.
struct Outcome {
    int code = -1;
    std::string out, err;
};

/// Runs `faqem ARGUMENTS` in the folder.
/// \param arguments  in shell syntax
inline Outcome run(const Folder& folder, const std::string& arguments) {
    const Folder streams;
    const std::string command = "cd '" + folder.path().string() + "' && '" + tool_path + "' " + arguments +
                                " >'" + (streams / "out").string() + "' 2>'" + (streams / "err").string() +
                                "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(streams / "out"), read(streams / "err")};
}

/// The lines of a text as JSON.
inline std::vector<nlohmann::json> json_lines(const std::string& text) {
    std::vector<nlohmann::json> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
}

/// The output lines of a batch, by the path of their model.
inline std::map<std::string, nlohmann::json> lines_by_path(const Outcome& outcome) {
    std::map<std::string, nlohmann::json> lines;
    for (const nlohmann::json& line : json_lines(outcome.out))
        CHECK(lines.emplace(line["path"], line).second);
    return lines;
}

/// True if the process has executed the faqem command and has installed a handler for the signal.
inline bool handles(pid_t process, int number) {
    std::ifstream name("/proc/" + std::to_string(process) + "/comm");
    std::string running;
    if (!(name >> running) || running != "faqem")
        return false;  // still the forked test program with its own handlers
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    std::string line;
    while (std::getline(status, line)) {
        if (line.rfind("SigCgt:", 0) == 0) {
            return std::stoull(line.substr(7), nullptr, 16) >> (number - 1) & 1;
        }
    }
    return false;
}

/// Starts `faqem WORDS` in the folder. Its output is in the file `lines` there.
template <class... Words>
pid_t start(const Folder& folder, Words... words) {
    const pid_t process = fork();
    if (process < 0) throw std::runtime_error("cannot fork");
    if (process > 0) return process;
    if (chdir(folder.path().c_str()) == 0 && std::freopen("lines", "w", stdout))
        execl(tool_path, "faqem", words..., nullptr);
    _exit(99);
}

/// Sends a signal to a running command as soon as it has a handler for it, and waits for its end.
/// \return its exit code, -1 if it was ended by the signal
inline int signal_and_wait(pid_t process, int number) {
    int status = 0;
    // Also stops if the process has ended before it installed its handler.
    while (!handles(process, number) && waitpid(process, &status, WNOHANG) == 0) std::this_thread::yield();
    kill(process, number);
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// An image whose left half is red and right half is blue.
inline faqem::Image two_colours() {
    const auto color = [](std::uint32_t x, std::uint32_t) {
        return x < 32 ? faqem::test::Rgba{255, 0, 0, 255} : faqem::test::Rgba{0, 0, 255, 255};
    };
    return faqem::encode_png(faqem::test::paint(64, 32, color), "two");
}

/// A bumpy grid of n x n quads over [-1, 1]^2 with normals near +z, red on the left and blue on the right.
/// \param bumps  amplitude
inline faqem::Asset sheet(faqem::Index n, double bumps = 0.05) {
    const auto uv_of = [n](const faqem::Vec3& p) { return std::array{p[0] / n, 1 - p[1] / n}; };
    faqem::Part part = faqem::test::uv_mapped(faqem::test::part_of(faqem::test::grid(n)), uv_of);
    part.name = "sheet";
    for (faqem::Vec3& p : part.positions) {
        const double u = p[0] / n, v = p[1] / n;
        p = {2 * u - 1, 2 * v - 1, bumps * std::sin(9 * u) * std::cos(7 * v)};
    }
    faqem::Asset asset;
    faqem::Material material;
    material.base_color_texture.image = 0;
    material.metallic = 0;
    asset.materials.push_back(material);
    asset.images.push_back(two_colours());
    asset.parts.push_back(part);
    return asset;
}

/// A folder with a file of a model.
struct ModelFolder : Folder {
    ModelFolder(const std::string& file, const faqem::Asset& model) { faqem::save(model, *this / file); }
};

}  // namespace tool_test
