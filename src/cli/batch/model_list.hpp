#pragma once
/// \file
/// Lists of models: JSON lines that say what a batch has to do.

#include <filesystem>
#include <functional>
#include <string>

#include "cli/batch/plan.hpp"

namespace faqem::cli {

/// Reads a list: JSON lines with the members `id`, which is unique, `input`, relative to the folder of the list, `sha256`
/// (model_hash()), `bytes` (of the input, with the files that it refers to), `output` (in the output directory) and
/// `options`, of which the first two are required; or, if its name ends in .csv, a table with the columns `sha256`, which is
/// the id, and `local_path`.
/// \param wanted  tells from its id whether a model is needed: the others are only searched for their id
/// \param take    receives each wanted model, in the order of the list, with what the list says
/// \return the SHA-256 of the file, as 64 hexadecimal digits
/// \throws ReadError   the file cannot be read
/// \throws InputError  a line is no JSON object, lacks a member, or has one of another type; the message has its number
/// Complexity: reads the file once, in O(size of the list) time, O(length of the longest line) memory.
std::string read_list(const std::filesystem::path& list,
                      const std::function<bool(const std::string& id)>& wanted,
                      const std::function<void(BatchFile&&)>& take);

/// Returns a line of a list, with its end.
/// \param folder  of the list; the path of the input is written relative to it
std::string list_line(const BatchFile& model, const std::filesystem::path& folder);

}  // namespace faqem::cli
