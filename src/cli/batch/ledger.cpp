#include "cli/batch/ledger.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <random>

#include "asset/io/file.hpp"
#include "asset/io/file_set.hpp"
#include "cli/files/output_file.hpp"
#include "faqem/error.hpp"
#include "faqem/version.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// The folder with the records of an output directory.
fs::path records_folder(const fs::path& out_folder) { return out_folder / ".faqem-batch"; }

fs::path run_file(const fs::path& out_folder) { return records_folder(out_folder) / "run.json"; }

fs::path completion_file(const fs::path& out_folder, const Shard& shard) {
    return records_folder(out_folder) / shard.name() / "complete.json";
}

/// The first member in which a file differs from a run; empty if it has all.
std::string differing_member(const fs::path& file, const Json& run) {
    const Json other = Json::parse(detail::read_file(file), nullptr, false);
    for (const auto& [name, value] : run.items())
        if (!other.is_object() || other.value(name, Json()) != value) return name;
    return {};
}

/// A name that no other attempt has, later than those before: time, process, and a random number.
std::string attempt_name() {
    std::timespec now = {};
    std::timespec_get(&now, TIME_UTC);
    std::tm utc = {};
    ::gmtime_r(&now.tv_sec, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y%m%dT%H%M%S.", &utc);
    return text + std::to_string(1'000'000'000 + now.tv_nsec).substr(1) + "-" + std::to_string(::getpid()) +
           "-" + std::to_string(std::random_device()());
}

/// The files of the attempts at a shard, the oldest first.
std::vector<fs::path> attempts_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".jsonl") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// Calls a function with each line of a ledger. A last line that a crash has cut was not written.
template <class Take>
void for_each_line(const fs::path& file, const Take& take) {
    std::ifstream in(file, std::ios::binary);
    for (std::string line; std::getline(in, line) && !in.eof();)
        if (const Json json = Json::parse(line, nullptr, false); json.is_object() && json.contains("id"))
            take(json);
}

}  // namespace

Ledger::Ledger(const fs::path& out_folder, const std::string& name, bool reads) {
    const fs::path folder = records_folder(out_folder) / name;
    make_folder(folder);
    for (const fs::path& file : reads ? attempts_in(folder) : std::vector<fs::path>()) {
        std::vector<std::string> open;
        for_each_line(file, [&](const Json& line) { read_line(line, open); });
        for (const std::string& key : open) ++histories_[key].unended;
    }
    file_ = folder / (attempt_name() + ".jsonl");
    out_ =
        detail::Descriptor(::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666));
    if (!out_) detail::fail_write(file_, "write", errno);
}

/// \param open  models that the attempt has begun and not ended
void Ledger::read_line(const Json& json, std::vector<std::string>& open) {
    const std::string key =
        json_line(Json::array({json.value("id", ""), json.value("sha256", ""), json.value("options", "")}));
    const std::string event = json.value("event", "");
    EarlierResult& result = results_[json.value("result", "")];
    if (event == "started") {
        // Of several attempts without an end any may have written the result.
        if (!result.replaced) result.replaced = json.value("replaced", "");
        return open.push_back(key);
    }
    std::erase(open, key);
    ModelHistory& history = histories_[key];
    if (event == "done")
        result = {json.value("inputs", ""), json.value("options", ""), json.value("written", ""),
                  json.value("faces_in", std::uint64_t{0}), json.value("faces_out", std::uint64_t{0})};
    if (event == "refused") result.replaced.reset();
    if (event == "done" || event == "refused") {
        history.end = event;
        history.bytes = json.value("bytes", std::uint64_t{0});
    }
    if (event == "crashed") ++history.crashes;
    if (event != "interrupted") history.reason = json.value("message", "");
}

ModelHistory Ledger::history(const BatchFile& model) const {
    const auto found = histories_.find(json_line(Json::array({model.name, model.hash, model.options_id})));
    return found == histories_.end() ? ModelHistory() : found->second;
}

std::optional<EarlierResult> Ledger::earlier_result(const BatchFile& model) const {
    const auto found = results_.find(model.out_name);
    return found == results_.end() ? std::optional<EarlierResult>() : found->second;
}

void Ledger::begin(const BatchFile& model) {
    add(model, "started", {{"replaced", modification_stamp({model.out})}});
}

void Ledger::add(const BatchFile& model, const std::string& event, const Json& details) {
    Json line = {{"event", event},       {"id", model.name},
                 {"sha256", model.hash}, {"options", model.options_id},
                 {"version", version()}, {"result", model.out_name}};
    line.update(details);
    const std::string text = json_line(line);
    if (!detail::write_all(out_.get(), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}))
        detail::fail_write(file_, "write", errno);
}

void join_run(const fs::path& out_folder, const RunIdentity& run, bool replaces) {
    const fs::path file = run_file(out_folder);
    make_folder(file.parent_path());
    if (replaces) return write_output(file, json_line(run), Overwrite::yes);
    if (!fs::exists(file)) {
        try {
            return write_output(file, json_line(run), Overwrite::no);
        } catch (const WriteError&) {
            if (!fs::exists(file)) throw;  // otherwise another shard was faster
        }
    }
    if (const std::string name = differing_member(file, run); !name.empty())
        throw OptionError(file.string() + ": the directory has the results of a run with other " + name +
                          "; choose another directory, or --new-run");
}

void complete_shard(const fs::path& out_folder, const Shard& shard, const RunIdentity& run,
                    const Json& counts) {
    Json json = run;
    json.update(counts);
    write_output(completion_file(out_folder, shard), json_line(json), Overwrite::yes);
}

RunIdentity read_run(const fs::path& out_folder) {
    const fs::path file = run_file(out_folder);
    try {
        RunIdentity run = Json::parse(detail::read_file(file));
        for (const char* text : {"options", "version", "list"}) run.at(text).get<std::string>();
        if (run.at("shards").get<std::uint64_t>() > 0) return run;
    } catch (const Json::exception&) {
    }
    throw InputError(file.string(), "", "is damaged");
}

bool is_complete(const fs::path& out_folder, const Shard& shard, const RunIdentity& run) {
    const fs::path file = completion_file(out_folder, shard);
    return fs::exists(file) && differing_member(file, run).empty();
}

std::map<std::string, Json> last_records(const fs::path& out_folder, const Shard& shard) {
    std::map<std::string, Json> records;
    for (const fs::path& file : attempts_in(records_folder(out_folder) / shard.name()))
        for_each_line(file, [&](const Json& line) {
            Json& record = records[line.value("id", "")];
            // An attempt that has only begun says nothing new of a model with an end.
            if (line.value("event", "") != "started" || record.is_null()) record = line;
        });
    return records;
}

}  // namespace faqem::cli
