#pragma once
/// \file
/// What the records of all shards say together.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cli/batch/shard.hpp"
#include "cli/process/json.hpp"

namespace faqem::cli {

/// The shards of a run that have models without an end, in increasing order.
/// \throws ReadError, InputError  the directory has no run, or its run.json is damaged
std::vector<Shard> incomplete_shards(const std::filesystem::path& out_folder);

/// Options of sbatch that start an array job for some shards, a line for each range of `max_array` shards:
/// `--array=3,7-9 --export=ALL,FAQEM_SHARD_COUNT=5000,FAQEM_SHARD_OFFSET=2000`.
/// \param shards     in increasing order
/// \param max_array  indices of an array are below it; at least 1
std::string array_options(const std::vector<Shard>& shards, std::uint64_t max_array);

struct RunSummary {
    std::map<std::string, std::uint64_t> counts;  ///< models by their end
    /// The last records of models without a result, then those with the most bytes of output per byte of input; at most
    /// `max_worst`.
    std::vector<Json> worst;
    std::vector<std::string> problems;  ///< shards that are not complete, outputs with two models
    static constexpr std::size_t max_worst = 1000;
};

/// Reads the records of all shards.
/// \param take  receives the last record of each model, in the order of the shards and in them of the ids
/// \throws ReadError, InputError  as incomplete_shards()
/// Complexity: O(size of the records) time; memory for one shard, and 8 bytes for each model.
RunSummary merge_records(const std::filesystem::path& out_folder,
                         const std::function<void(const Json&)>& take);

}  // namespace faqem::cli
