#pragma once
/// \file
/// The records of a batch: what every attempt has begun and ended, so that any machine can go on.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "asset/io/descriptor.hpp"
#include "cli/batch/plan.hpp"
#include "cli/batch/shard.hpp"
#include "cli/process/json.hpp"

namespace faqem::cli {

/// What the results of a run depend on besides the models, as the members of a JSON object: `shards` (their number, > 0),
/// `options` (BatchContext::options_key), `version`, and `list` (hash of the file). All shards of an output directory have
/// the same.
using RunIdentity = Json;

/// What has become of a model in all attempts, for its present hash and options.
struct ModelHistory {
    std::string end;            ///< `done` or `refused`; empty: neither
    std::uint64_t bytes = 0;    ///< of the output, if done
    std::uint32_t crashes = 0;  ///< attempts that ended in a crash
    std::uint32_t unended = 0;  ///< attempts that began it and recorded no end: the machine went away
    std::string reason;         ///< message of the last end
};

/// The ledger of one attempt: a new file of JSON lines in `.faqem-batch/NAME/` of the output directory. Several attempts
/// may run at the same time, since each writes its own file only; no lock is needed.
class Ledger {
public:
    /// Begins an attempt.
    /// \param name   of the shard; `directory` if there is no list
    /// \param reads  whether other attempts count
    /// \throws WriteError  the files cannot be written
    Ledger(const std::filesystem::path& out_folder, const std::string& name, bool reads);

    /// What earlier attempts, and others that run now, have recorded about a model. Lines that are cut are ignored, and
    /// those of another hash or other options.
    ModelHistory history(const BatchFile& model) const;
    /// What they have recorded about the result, whatever the model was then; nothing if it was never begun.
    std::optional<EarlierResult> earlier_result(const BatchFile& model) const;

    /// Records that a model begins. \throws WriteError
    void begin(const BatchFile& model);
    /// Records what has become of a model. \param event  `started`, `done`, `refused`, `crashed`, `poisoned` or `interrupted`
    /// \param details  more members of the line
    /// \throws WriteError
    void add(const BatchFile& model, const std::string& event, const Json& details);

private:
    void read_line(const Json& json, std::vector<std::string>& open);

    std::filesystem::path file_;
    detail::Descriptor out_;
    std::map<std::string, ModelHistory> histories_;  // by id, hash and options
    std::map<std::string, EarlierResult> results_;   // by BatchFile::out_name
};

/// Begins an attempt at a shard of a run: the first one of a run writes `.faqem-batch/run.json`.
/// \param replaces  whether another run may have been there
/// \throws OptionError  the directory has the results of another run; the message says in what it differs
/// \throws WriteError   the file cannot be written
void join_run(const std::filesystem::path& out_folder, const RunIdentity& run, bool replaces);

/// Records that no model of a shard is left. \param counts  numbers of models by their end \throws WriteError
void complete_shard(const std::filesystem::path& out_folder, const Shard& shard, const RunIdentity& run,
                    const Json& counts);

/// The run of an output directory. \throws ReadError, InputError  there is none, or its file is damaged
RunIdentity read_run(const std::filesystem::path& out_folder);

/// Whether a shard of a run is complete: each of its models has an end.
bool is_complete(const std::filesystem::path& out_folder, const Shard& shard, const RunIdentity& run);

/// The last record of each model of a shard, by id, of any attempt. One that was begun and has no end has the event
/// `started`.
std::map<std::string, Json> last_records(const std::filesystem::path& out_folder, const Shard& shard);

}  // namespace faqem::cli
