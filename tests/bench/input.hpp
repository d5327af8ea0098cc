#pragma once
/// \file
/// Input meshes of the benchmarks.

#include <filesystem>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::bench {

/// Returns the .obj, .ply, .stl and .off files of a directory, sorted by name.
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& folder);

/// Loads all parts of a file as one mesh. Equal positions are welded, faces with equal corners and
/// unreferenced vertices are dropped, so that all simplifiers get the same arrays, whether or not they weld.
/// Faces of zero area with three different corners are kept, because dropping them would create cracks.
/// \throws Error  the file cannot be read
TriangleMesh load_welded(const std::filesystem::path& file);

/// Writes an OBJ file with all digits of the positions, for other measuring programs.
/// \throws WriteError  the file cannot be written
void save_obj(const TriangleMesh& mesh, const std::filesystem::path& file);

}  // namespace faqem::bench
