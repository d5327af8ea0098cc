#pragma once
/// \file
/// The material libraries of an OBJ file.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "asset/formats/mtl.hpp"
#include "asset/io/file_finder.hpp"

namespace faqem::detail {

/// Returns the file names in an mtllib statement. The whole statement is one name if such a file exists;
/// otherwise it is split after each `.mtl`.
/// \param statement  without its keyword
/// \param folder     folder of the OBJ file
std::vector<std::string> library_names(const std::string& statement, const std::filesystem::path& folder);

/// Finds a library that an OBJ file names. If it is missing, the only library in the folder stands in for it, unless that
/// has the name of another OBJ file there.
/// \param model  path of the OBJ file
/// \throws InputError  there is none: the error of FileFinder::find()
FoundFile find_library(const std::string& name, const std::filesystem::path& model, FileFinder& finder);

/// Reads all material libraries. If a name is defined repeatedly, the last definition is used. A library that is
/// missing, or found under another name, is a warning.
/// \param statements  mtllib statements without their keyword
/// \param model       path of the OBJ file
/// \param warnings    receives the warnings
/// \param ignored     as for read_mtl()
/// \return the materials by name
/// \throws InputError  as read_mtl()
std::map<std::string, MtlMaterial> read_libraries(const std::vector<std::string>& statements,
                                                  const std::filesystem::path& model, FileFinder& finder,
                                                  std::vector<std::string>& warnings,
                                                  IgnoredStatements& ignored);

}  // namespace faqem::detail
