#include <fstream>
#include <stdexcept>

#include "../support/temporary_folder.hpp"
#include "input.hpp"
#include "simplifier.hpp"

namespace faqem::bench {

Outcome package(const std::string& name, const TriangleMesh& in, std::size_t target_faces) {
    const testing::TemporaryFolder folder;
    const std::string before = folder / "in.obj", after = folder / "out", errors = folder / "errors";
    save_obj(in, before);
    const std::string command = "python3 -B '" FAQEM_BENCH_PACKAGES "' " + name + " '" + before + "' '" +
                                after + "' " + std::to_string(target_faces) + " 2>'" + errors + "'";
    if (std::system(command.c_str()) != 0) {
        std::string last = "killed";
        std::ifstream file(errors);
        for (std::string line; std::getline(file, line);) last = line;
        throw std::runtime_error(last);
    }
    // OBJ or GLB, as the package writes it. Such files are read with equal positions merged, as the input was.
    const bool obj = std::filesystem::exists(after + ".obj");
    return {load_welded(after + (obj ? ".obj" : ".glb")), 0, {}};
}

}  // namespace faqem::bench
