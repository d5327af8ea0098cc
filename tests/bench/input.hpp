#pragma once
/// \file
/// The meshes of the benchmark.

#include <filesystem>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::bench {

/// The .obj, .ply, .stl and .off files of a folder, by name.
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& folder);

/// All parts of a file as one mesh. Equal positions are one vertex, faces with equal corners are left out,
/// and so are unused vertices: every simplifier gets the same arrays, whatever it would weld by itself. Faces
/// with three different corners and no area stay, because without them there would be cracks.
/// \throws Error  the file cannot be read
TriangleMesh load_welded(const std::filesystem::path& file);

/// Writes an OBJ file with all digits, for other judges. \throws WriteError
void save_obj(const TriangleMesh& mesh, const std::filesystem::path& file);

}  // namespace faqem::bench
