#pragma once
/// \file
/// Protection of files: nothing that an input of the command, or another model beside an output, is or refers to is
/// overwritten.

#include <filesystem>
#include <span>
#include <vector>

namespace faqem::cli {

/// Protects an input file of the command and all files that it refers to (References::all). From now on no
/// file that is the same as one of them can be written, neither by write_output() nor by save(): files are
/// compared by device and inode, so that links, relative paths and letter case do not matter. Files that do
/// not exist need no protection. Call this before the first output is checked or written. From then on the
/// files beside a model are also checked by check_side_files_unshared().
///
/// The input is examined when the first existing file is about to be overwritten: for most runs, never.
void protect_input(const std::filesystem::path& input);

/// Checks that a file may be written. write_output() and save() check their files too; commands that write
/// several files call this before they write the first one.
/// \throws OptionError  the file is an input
/// \throws WriteError   an input refers to the file; the message names both
void check_unprotected(const std::filesystem::path& file);

/// Checks models that save() will write, with the files beside them. How many images a model will have is not
/// known before it is baked, so this rejects every protected file with the name of an image of the model.
/// For commands that write files while others are not known yet.
/// \throws OptionError, WriteError  as check_unprotected()
void check_models_unprotected(const std::vector<std::filesystem::path>& models);

/// Checks files that are written together: the files beside STEM.gltf and STEM.obj have names that both use
/// (STEM_0.png), so that writing one model could replace an image of the other. For each .gltf and .obj file
/// among the files, STEM.gltf, STEM.obj and STEM.mtl of its folder are examined if they are not written
/// themselves.
/// \param files  paths as they are written
/// \throws WriteError  an existing file would be overwritten that such a model or library refers to; the
///                     message names both
/// Complexity: reads the other models, if one of the files beside the model exists.
void check_side_files_unshared(std::span<const std::filesystem::path> files);

}  // namespace faqem::cli
