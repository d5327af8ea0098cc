#pragma once
/// \file
/// What is checked about output files before any work is done, and how they are written.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::cli {

/// Makes sure that a file may be written: its folder is there and can be written to, it is none of the inputs
/// (by inode, so that links do not hide it), it is no device or pipe, and it does not exist unless that is
/// allowed.
/// \throws OptionError  it is an input
/// \throws WriteError   otherwise
void check_output(const std::filesystem::path& file, const std::vector<std::filesystem::path>& inputs,
                  Overwrite overwrite);

/// The extension of the name with its dot, in lower case.
std::string lower_case_extension(const std::filesystem::path& file);

/// Makes sure that the name ends in one of the extensions, in any case.
/// \throws OptionError
void check_extension(const std::filesystem::path& file, const std::vector<std::string_view>& extensions);

/// The extension of a format's files: `.glb` of `glb`. \throws OptionError  --format has no such value
std::string extension_of_format(const std::string& format);

/// Makes a folder where there is none. \throws WriteError
void make_folder(const std::filesystem::path& folder);

/// Writes a text or binary file, complete or not at all. \throws WriteError
void write_output(const std::filesystem::path& file, std::string_view content, Overwrite overwrite);

}  // namespace faqem::cli
