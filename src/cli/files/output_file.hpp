#pragma once
/// \file
/// Checks of output files before the work starts, and writing of files.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "asset/io/file_set.hpp"
#include "faqem/asset.hpp"

namespace faqem::cli {

/// Checks that a file can be written: it is not protected (protect_input()), nor is the buffer of a .gltf
/// file, its directory exists and is writable, it is not a directory, device or pipe, and it exists only if
/// it may be overwritten. Other files beside a model are checked when it is saved. Removes the temporary
/// files that dead processes left in the directory, and completes or restores a set of files that one
/// replaced only in part.
/// \param advice  what the message says about a file that exists
/// \throws OptionError  the file is an input
/// \throws WriteError   any other condition is violated
void check_output(const std::filesystem::path& file, Overwrite overwrite,
                  const std::string& advice = "use --force to overwrite it");

/// Calls protect_input() and check_output() for the files of a command, before the work starts, which may take hours, and
/// then install_signal_handlers(). At a terminal it asks once whether outputs that exist may be overwritten. Empty names are
/// left out.
/// \param outputs  must be different, whether or not they exist
/// \param force    the answer without a question
/// \throws OptionError, WriteError  as check_output()
Overwrite prepare_files(const std::vector<std::filesystem::path>& inputs,
                        std::vector<std::filesystem::path> outputs, bool force);

/// Checks that a file name has one of the extensions, ignoring case.
/// \param extensions  in lower case, with the dot
/// \throws OptionError  the extension is another one
void check_extension(const std::filesystem::path& file, const std::vector<std::string_view>& extensions);

/// Values of --format, with bars between: the extensions of the formats that can be written, without the dot. The first
/// is the default.
std::string format_names();

/// The default value of --format.
std::string default_format();

/// Returns Options::format for an output file; `automatic` if its extension is unknown.
ModelFormat format_of_output(const std::filesystem::path& file);

/// Creates a directory and its parents if they do not exist. \throws WriteError  this fails
void make_folder(const std::filesystem::path& folder);

/// Writes a text or binary file atomically: after a failure the file is unchanged. Adds it to the set of
/// detail::CollectWrites if there is one. \throws WriteError  writing fails
void write_output(const std::filesystem::path& file, std::string_view content, Overwrite overwrite);

/// Gives the files of a command, whose bytes are on the disk, their names: all or none. A signal received
/// before ends the process, a later one no longer changes the exit code. \throws WriteError  no file is
/// replaced
void commit_outputs(detail::FileSet& set);

/// Calls `write`, and gives the files that it writes, with write_output() or save(), their names: commit_outputs(). A
/// signal before ends the process, too.
void write_together(const std::function<void()>& write);

/// Writes the only file of a command, with write_output() and commit_outputs().
void write_only_output(const std::filesystem::path& file, std::string_view content, Overwrite overwrite);

}  // namespace faqem::cli
