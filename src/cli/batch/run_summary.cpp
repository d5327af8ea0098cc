#include "cli/batch/run_summary.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "cli/batch/ledger.hpp"
#include "cli/files/sha256.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// Bytes of output for each byte of input; larger for models without a result.
double badness(const Json& record) {
    if (record.value("event", "") != "done") return 1e300;
    return record.value("bytes", 0.0) / std::max(record.value("input_bytes", 0.0), 1.0);
}

}  // namespace

std::vector<Shard> incomplete_shards(const fs::path& out_folder) {
    const RunIdentity run = read_run(out_folder);
    std::vector<Shard> shards;
    for (Shard shard{0, run["shards"]}; shard.index < shard.count; ++shard.index)
        if (!is_complete(out_folder, shard, run)) shards.push_back(shard);
    return shards;
}

std::string array_options(const std::vector<Shard>& shards, std::uint64_t max_array) {
    std::string text;
    for (std::size_t i = 0; i < shards.size();) {
        const std::uint64_t offset = shards[i].index / max_array * max_array;
        std::string indices;
        while (i < shards.size() && shards[i].index < offset + max_array) {
            const std::uint64_t first = shards[i].index - offset;
            std::uint64_t last = first;
            while (++i < shards.size() && shards[i].index == offset + last + 1 && last + 1 < max_array)
                ++last;
            indices += (indices.empty() ? "" : ",") + std::to_string(first);
            if (last > first) indices += "-" + std::to_string(last);
        }
        text += "--array=" + indices + " --export=ALL,FAQEM_SHARD_COUNT=" + std::to_string(shards[0].count) +
                ",FAQEM_SHARD_OFFSET=" + std::to_string(offset) + "\n";
    }
    return text;
}

RunSummary merge_records(const fs::path& out_folder, const std::function<void(const Json&)>& take) {
    const RunIdentity run = read_run(out_folder);
    RunSummary summary;
    std::multimap<double, Json, std::greater<>> worst;      // equal ones are in the order of their insertion
    std::unordered_map<std::uint64_t, std::string> owners;  // ids by output, for those that the list names
    for (Shard shard{0, run["shards"]}; shard.index < shard.count; ++shard.index) {
        if (!is_complete(out_folder, shard, run))
            summary.problems.push_back("shard " + shard.name() + " is not complete");
        for (const auto& [id, record] : last_records(out_folder, shard)) {
            take(record);
            ++summary.counts[record.value("event", "")];
            worst.emplace(badness(record), record);
            if (worst.size() > RunSummary::max_worst) worst.erase(std::prev(worst.end()));
            const std::string output = record.value("result", "");
            if (output.empty() || output == default_output(id, fs::path(output).extension().string()))
                continue;
            const auto [owner, is_new] = owners.emplace(short_hash(output), id);
            if (!is_new && owner->second != id)
                summary.problems.push_back(output + " is the output of two models: " + owner->second +
                                           " and " + id);
        }
    }
    for (auto& [value, record] : worst) summary.worst.push_back(std::move(record));
    return summary;
}

}  // namespace faqem::cli
