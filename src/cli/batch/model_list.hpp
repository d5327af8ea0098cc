#pragma once
/// \file
/// Lists of models: JSON lines that say what a batch has to do.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "cli/process/json.hpp"

namespace faqem::cli {

/// A line of a list.
struct ListedModel {
    std::string id;               ///< unique in the list
    std::filesystem::path input;  ///< relative paths in the file are relative to the folder of the list
    std::string hash = {};        ///< model_hash(); empty: not recorded
    std::uint64_t bytes = 0;      ///< size of the input, with the files that it refers to
    std::string output = {};      ///< path in the output directory; empty: chosen from the id
    Json options = {};            ///< of this model, with the names of the command; null: none
};

/// Reads a list: JSON lines with the members `id`, `input`, `sha256`, `bytes`, `output` and `options`, of which the
/// first two are required; or, if its name ends in .csv, a table with the columns `sha256`, which is the id, and
/// `local_path`.
/// \param wanted  tells from its id whether a model is needed: the others are only searched for their id
/// \param take    receives each wanted model, in the order of the list
/// \return the SHA-256 of the file, as 64 hexadecimal digits
/// \throws ReadError   the file cannot be read
/// \throws InputError  a line is no JSON object, lacks a member, or has one of another type; the message has its number
/// Complexity: reads the file once, in O(size of the list) time, O(length of the longest line) memory.
std::string read_list(const std::filesystem::path& list,
                      const std::function<bool(const std::string& id)>& wanted,
                      const std::function<void(ListedModel&&)>& take);

/// Returns a line of a list, with its end.
/// \param folder  of the list; the path of the input is written relative to it
std::string list_line(const ListedModel& model, const std::filesystem::path& folder);

}  // namespace faqem::cli
