#pragma once
/// \file
/// The records of a batch over a list: what every attempt at a shard has begun and ended, so that any machine can go on.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "asset/io/locked_file.hpp"
#include "cli/batch/shard.hpp"
#include "cli/process/json.hpp"

namespace faqem::cli {

/// What the results of a run depend on besides the models. All shards of an output directory have the same.
struct RunIdentity {
    std::uint64_t shards = 1;
    std::string options;  ///< detail::options_key() and the format
    std::string version;
    std::string list;  ///< hash of the file
};

/// What has become of a model in all attempts, for its present hash, options and version.
struct ModelHistory {
    std::string end;            ///< `done` or `refused`; empty: neither
    std::uint64_t bytes = 0;    ///< of the output, if done
    std::uint32_t crashes = 0;  ///< attempts that ended in a crash
    std::uint32_t unended = 0;  ///< attempts that began it and recorded no end: the machine went away
    std::string reason;         ///< message of the last end
};

/// A model as the records know it: an attempt with other values does not count.
struct ModelKey {
    std::string id, hash, options;
};

/// The ledger of one attempt at a shard: a new file of JSON lines in `.faqem-batch/I-of-N/` of the output directory.
/// Several attempts may run at the same time, since each writes its own file only; no lock is needed.
class Ledger {
public:
    /// Begins an attempt. The first one of a run writes `.faqem-batch/run.json`.
    /// \param replaces_run  whether another run may have been there
    /// \throws OptionError  the directory has the results of another run; the message says in what it differs
    /// \throws WriteError   the files cannot be written
    Ledger(const std::filesystem::path& out_folder, const Shard& shard, const RunIdentity& run,
           bool replaces_run);

    /// What earlier attempts, and others that run now, have recorded. Lines that are cut are ignored.
    ModelHistory history(const ModelKey& model) const;

    /// Records that a model begins. \throws WriteError
    void begin(const ModelKey& model);
    /// Records the end of a model. \param event  `done`, `refused`, `crashed`, `poisoned` or `interrupted`
    /// \param details  more members of the line
    /// \throws WriteError
    void end(const ModelKey& model, const std::string& event, const Json& details);
    /// Records that no model of the shard is left. \param counts  numbers of models by their end \throws WriteError
    void complete(const Json& counts) const;

private:
    void append(const Json& line);
    void read_attempts();

    std::filesystem::path folder_, file_;
    RunIdentity run_;
    detail::Descriptor out_;
    std::map<std::string, ModelHistory> histories_;  // by key_text()
};

/// The run of an output directory. \throws ReadError, InputError  there is none, or its file is damaged
RunIdentity read_run(const std::filesystem::path& out_folder);

/// Whether a shard of a run is complete: each of its models has an end.
bool is_complete(const std::filesystem::path& out_folder, const Shard& shard, const RunIdentity& run);

/// The last record of each model of a shard, by id, of any attempt. One that was begun and has no end has the event
/// `started`.
std::map<std::string, Json> last_records(const std::filesystem::path& out_folder, const Shard& shard);

}  // namespace faqem::cli
