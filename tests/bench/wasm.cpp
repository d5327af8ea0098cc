#include "wasm.hpp"

#include <cstdint>
#include <cstdio>
#include <fstream>

#include "../support/temporary_folder.hpp"
#include "faqem/error.hpp"

namespace faqem::bench {

namespace {

namespace fs = std::filesystem;

template <typename Element>
void put(std::ostream& file, const std::vector<Element>& all) {
    file.write(reinterpret_cast<const char*>(all.data()),
               static_cast<std::streamsize>(all.size() * sizeof(Element)));
}

template <typename Element>
std::vector<Element> get(std::istream& file, std::size_t count) {
    std::vector<Element> all(count);
    file.read(reinterpret_cast<char*>(all.data()), static_cast<std::streamsize>(count * sizeof(Element)));
    return all;
}

std::vector<std::uint32_t> counts(const FloatMesh& mesh) {
    return {static_cast<std::uint32_t>(mesh.positions.size()),
            static_cast<std::uint32_t>(mesh.triangles.size())};
}

TriangleMesh read_mesh(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    const auto sizes = get<std::uint32_t>(file, 2);
    TriangleMesh mesh;
    for (const Vec3f& p : get<Vec3f>(file, sizes[0])) mesh.positions.push_back({p[0], p[1], p[2]});
    mesh.triangles = get<Triangle>(file, sizes[1]);
    if (!file) throw OptionError(path.string() + ": the file is truncated");
    return mesh;
}

/// Runs a command and returns its standard output.
std::string output_of(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) throw OptionError(command + ": cannot start the process");
    std::string output;
    char part[256];
    while (std::fgets(part, sizeof part, pipe) != nullptr) output += part;
    if (pclose(pipe) != 0) throw OptionError(command + ": the process failed");
    return output;
}

}  // namespace

bool is_wasm(const std::string& name) { return name.starts_with("wasm-"); }

Run run_wasm(const FloatMesh& in, std::size_t target_faces, const std::string& name) {
    const std::string update = "-update";
    const bool moves = name.ends_with(update);
    const std::string package = moves ? name.substr(0, name.size() - update.size()) : name;
    const fs::path index = fs::path(FAQEM_BENCH_WASM) / "node_modules" / package / "index.js";
    if (!fs::exists(index))
        throw OptionError("simplifier " + name + ": " + index.string() + " does not exist");

    const testing::TemporaryFolder folder;
    const std::string before = folder / "in", after = folder / "out";
    {
        std::ofstream file(before, std::ios::binary);
        put(file, counts(in));
        put(file, in.positions);
        put(file, in.triangles);
    }
    const std::string output =
        output_of("node '" FAQEM_BENCH_WASM "/simplify.mjs' '" + index.string() + "' '" + before + "' '" +
                  after + "' " + std::to_string(target_faces) + (moves ? " update" : ""));
    Run result;
    if (std::sscanf(output.c_str(), "%lf %lf", &result.seconds, &result.cpu_seconds) != 2)
        throw OptionError("simplifier " + name + ": unexpected output '" + output + "'");
    result.mesh = read_mesh(after);
    return result;
}

}  // namespace faqem::bench
