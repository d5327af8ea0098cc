#include "input.hpp"

#include <algorithm>
#include <fstream>
#include <limits>

#include "faqem/asset.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "faqem/error.hpp"

namespace faqem::bench {

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending == ".obj" || ending == ".ply" || ending == ".stl" || ending == ".off") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

TriangleMesh load_welded(const std::filesystem::path& file) {
    const Asset asset = load(file);
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (const Part& part : asset.parts) {
        const auto offset = static_cast<Index>(positions.size());
        positions.insert(positions.end(), part.positions.begin(), part.positions.end());
        for (const Triangle& t : part.triangles) {
            triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
        }
    }
    const std::vector<Index> first = engine::weld_exact(positions);
    TriangleMesh mesh;
    std::vector<Index> number(positions.size(), no_index);
    for (const Triangle& t : triangles) {
        const Triangle corners = {first[t[0]], first[t[1]], first[t[2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        Triangle& out = mesh.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            Index& v = number[corners[k]];
            if (v == no_index) {
                v = static_cast<Index>(mesh.positions.size());
                mesh.positions.push_back(positions[corners[k]]);
            }
            out[k] = v;
        }
    }
    return mesh;
}

void save_obj(const TriangleMesh& mesh, const std::filesystem::path& file) {
    std::ofstream out(file);
    out.precision(std::numeric_limits<double>::max_digits10);
    for (const Vec3& p : mesh.positions) out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (const Triangle& t : mesh.triangles) {
        out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    }
    out.close();
    if (!out) throw WriteError(file.string() + ": cannot write the file");
}

}  // namespace faqem::bench
