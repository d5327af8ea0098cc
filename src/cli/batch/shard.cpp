#include "cli/batch/shard.hpp"

#include <charconv>
#include <cstdlib>

#include "asset/io/file.hpp"
#include "cli/files/sha256.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

/// Bytes of the longest id, written as a name. A file may have 255, of which images beside a result and temporary files
/// need some.
constexpr std::size_t max_name_size = 200;

std::optional<std::uint64_t> parse_number(const std::string& text) {
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (text.empty() || error != std::errc() || stop != end) return std::nullopt;
    return number;
}

Shard checked_shard(std::uint64_t index, std::uint64_t count) {
    if (!(index < count))
        throw OptionError("--shard: " + std::to_string(index) + " of " + std::to_string(count) +
                          " is out of range: the first shard is 0");
    return {index, count};
}

/// A variable with the index of a task, and the one with the number of tasks; empty: there is none.
struct TaskVariables {
    const char *index, *count;
};
constexpr TaskVariables task_variables[] = {{"FAQEM_SHARD_INDEX", ""},
                                            {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT"},
                                            {"AWS_BATCH_JOB_ARRAY_INDEX", "AWS_BATCH_JOB_ARRAY_SIZE"},
                                            {"JOB_COMPLETION_INDEX", ""},
                                            {"RANK", "WORLD_SIZE"}};

Shard automatic_shard(const Environment& environment) {
    const auto number = [&](const std::string& name) -> std::optional<std::uint64_t> {
        const std::optional<std::string> text = environment(name);
        if (!text) return std::nullopt;
        if (const auto parsed = parse_number(*text)) return parsed;
        throw OptionError("--shard auto: " + name + " is no number: '" + *text + "'");
    };
    for (const TaskVariables& task : task_variables) {
        std::optional<std::uint64_t> index = number(task.index);
        if (!index) continue;
        *index += number("FAQEM_SHARD_OFFSET").value_or(0);
        if (const auto count = number("FAQEM_SHARD_COUNT")) return checked_shard(*index, *count);
        const std::optional<std::uint64_t> count = number(task.count);
        if (!count)
            throw OptionError(std::string("--shard auto: ") + task.index +
                              " is set, but not the number of shards; set FAQEM_SHARD_COUNT");
        if (task.index == std::string("SLURM_ARRAY_TASK_ID")) {
            const std::uint64_t first = number("SLURM_ARRAY_TASK_MIN").value_or(0);
            const std::uint64_t last = number("SLURM_ARRAY_TASK_MAX").value_or(first + *count - 1);
            if (last - first + 1 != *count || *index < first)
                throw OptionError(
                    "--shard auto: the array of Slurm has gaps, so that the number of shards is unknown; set "
                    "FAQEM_SHARD_COUNT");
            *index -= first;
        }
        return checked_shard(*index, *count);
    }
    throw OptionError(
        "--shard auto: no variable has the index of a shard: FAQEM_SHARD_INDEX, SLURM_ARRAY_TASK_ID, "
        "AWS_BATCH_JOB_ARRAY_INDEX, JOB_COMPLETION_INDEX or RANK");
}

}  // namespace

bool Shard::contains(const std::string& id) const { return count == 1 || short_hash(id) % count == index; }

std::string Shard::name() const { return std::to_string(index) + "-of-" + std::to_string(count); }

std::optional<std::string> environment_variable(const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return value ? std::optional<std::string>(value) : std::nullopt;
}

Shard parse_shard(const std::string& text, const Environment& environment) {
    if (text == "auto") return automatic_shard(environment);
    const std::size_t slash = text.find('/');
    if (slash != std::string::npos) {
        const auto index = parse_number(text.substr(0, slash)), count = parse_number(text.substr(slash + 1));
        if (index && count) return checked_shard(*index, *count);
    }
    throw OptionError("--shard: '" + text + "' is neither I/N nor auto");
}

std::string default_output(const std::string& id, const std::string& extension) {
    const std::string hash = sha256(id), name = detail::percent_encoded(id, "-._");
    return hash.substr(0, 2) + "/" + (name.size() > max_name_size ? hash : name) + extension;
}

}  // namespace faqem::cli
