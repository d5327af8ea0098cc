#include "cli/batch/batch_run.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "cli/batch/model_list.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/sha256.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"
#include "faqem/version.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// Attempts that crash, and attempts without an end, after which a model is given up. A machine that goes away is rarely
/// the fault of the model.
constexpr std::uint32_t max_crashes = 2, max_unended = 5;

/// Reads the options that a list has for a model.
void set_own_options(BatchFile& file, GivenOptions given) {
    for (const auto& [name, value] : file.listed_options.items()) {
        const detail::OptionRow& row = detail::named_option(name);
        if (!(row.entry_points & detail::in_batch)) throw OptionError(name + ": is no option of faqem batch");
        given.emplace_back(&row, value.is_string()    ? value.get<std::string>()
                                 : value.is_boolean() ? (value.get<bool>() ? "on" : "off")
                                                      : value.dump());
    }
    file.options = make_options(given);
}

bool is_inside(const fs::path& path, const fs::path& folder) {
    const fs::path relative = fs::weakly_canonical(path).lexically_relative(fs::weakly_canonical(folder));
    return !relative.empty() && *relative.begin() != "..";
}

/// Gives a model of a list its output and options.
void complete_model(BatchFile& file, const RunArguments& arguments, const GivenOptions& given) {
    const auto fail = [&](const std::string& what) { throw InputError("", file.name, what); };
    if (file.out_name.empty()) file.out_name = default_output(file.name, arguments.extension);
    const fs::path out = fs::path(file.out_name).lexically_normal();
    if (out.is_absolute() || out.empty() || *out.begin() == ".." || *out.begin() == ".")
        fail("the output '" + file.out_name + "' is outside the output directory");
    file.out_name = out.generic_string();
    file.out = arguments.out_folder / out;
    if (is_inside(file.in, arguments.out_folder))
        fail("the input " + file.in.string() + " is inside the output directory");
    try {
        if (!file.listed_options.is_null()) set_own_options(file, given);
        check_extension(file.out, {".glb", ".gltf", ".vrm", ".obj", ".ply", ".stl"});
    } catch (const OptionError& error) {
        throw OptionError(arguments.list.string() + ": " + file.name + ": " + error.what());
    }
}

/// Whether a code says that the model itself is the reason, so that another attempt would end in the same way.
bool is_final(ExitCode code) {
    return code != exit_cancelled && code != exit_cannot_write && code != exit_internal;
}

class BatchRun {
public:
    BatchRun(const std::vector<BatchFile>& files, const RunArguments& arguments, const BatchContext& work,
             const std::function<void(const std::string&)>& print)
        : arguments_(arguments),
          has_list_(!arguments.list.empty()),
          models_(files.size()),
          work_(work),
          print_(print),
          ledger_(arguments.out_folder, has_list_ ? arguments.shard.name() : "directory",
                  arguments.reads_records) {
        if (has_list_) {
            run_ = {{"shards", arguments.shard.count},
                    {"options", work.options_key},
                    {"version", version()},
                    {"list", arguments.list_hash}};
            join_run(arguments.out_folder, run_, arguments.replaces_run);
        }
        for (BatchFile file : files) {
            const std::string own = file.options ? detail::options_key(*file.options) : "";
            file.options_id = sha256(work.options_key + own).substr(0, 16);
            if (!has_list_) file.earlier = ledger_.earlier_result(file);
            if (!has_list_ || !has_end(file)) todo_.push_back(std::move(file));
        }
    }

    ExitCode run() {
        process_batch(todo_, work_,
                      {[this](std::size_t i) {
                           todo_[i].has_begun = true;
                           ledger_.begin(todo_[i]);
                       },
                       [this](std::size_t i, const Json& line) { return end(i, line); }});
        if (!has_list_) return code_;
        if (done_ + refused_ + poisoned_ < models_) return exit_try_again;
        complete_shard(
            arguments_.out_folder, arguments_.shard, run_,
            {{"done", done_}, {"refused", refused_}, {"poisoned", poisoned_}, {"models", models_}});
        return exit_ok;
    }

private:
    /// Whether nothing is left to do with a model, by its history.
    bool has_end(BatchFile& file) {
        const ModelHistory history = ledger_.history(file);
        file.crashes = history.crashes;
        std::error_code error;
        if (history.end == "done" && fs::file_size(file.out, error) == history.bytes && !error)
            ++done_;
        else if (history.end == "refused")
            ++refused_;
        else if (history.crashes >= max_crashes)
            poison(file, history.reason);
        else if (history.unended >= max_unended)
            poison(file, std::to_string(history.unended) + " attempts have begun it and recorded no end");
        else
            return false;
        return true;
    }

    void poison(const BatchFile& file, const std::string& reason) {
        ++poisoned_;
        ledger_.add(file, "poisoned", {{"message", reason}});
        print_(printed_line(file, {{"status", "poisoned"}, {"code", exit_internal}, {"message", reason}}));
    }

    NextStep end(std::size_t i, const Json& line) {
        BatchFile& file = todo_[i];
        const auto code = line.at("code").get<ExitCode>();
        if (code == exit_internal) {
            record(file, "crashed", line);
            // Without a list only what the kernel kills is tried again: it does so when the machine has no memory left.
            if (++file.crashes < max_crashes && (has_list_ || line.value("killed", false)))
                return NextStep::again_alone;
            if (has_list_) {
                poison(file, line.at("message"));
                return NextStep::go_on;
            }
        } else if (code != exit_ok) {
            if (has_list_ && code == exit_cancelled && !file.has_begun) return NextStep::go_on;
            record(file, is_final(code) ? "refused" : "interrupted", line);
            refused_ += is_final(code);
        } else if (line.at("status") == "done") {
            record(file, "done", line);
            ++done_;
        }
        if (code == exit_cancelled)
            code_ = exit_cancelled;
        else if (code != exit_ok && code_ == exit_ok)
            code_ = exit_batch_incomplete;
        print_(printed_line(file, line));
        // Where one file cannot be written, others cannot either.
        return has_list_ && code == exit_cannot_write ? NextStep::stop : NextStep::go_on;
    }

    /// \param line  of process_batch_file()
    void record(const BatchFile& file, const std::string& event, Json line) {
        const Json more = line.value("record", Json());
        for (const char* other : {"record", "status", "killed"}) line.erase(other);
        line["input_bytes"] = file.bytes;
        if (more.is_object()) line.update(more);
        ledger_.add(file, event, line);
    }

    const RunArguments& arguments_;
    bool has_list_;
    std::uint64_t models_, done_ = 0, refused_ = 0, poisoned_ = 0;
    const BatchContext& work_;
    const std::function<void(const std::string&)>& print_;
    Ledger ledger_;
    RunIdentity run_;
    std::vector<BatchFile> todo_;
    ExitCode code_ = exit_ok;
};

}  // namespace

std::vector<BatchFile> models_of_shard(RunArguments& arguments, const GivenOptions& given) {
    std::vector<BatchFile> files;
    std::set<std::string> ids;
    std::map<std::string, std::string> owners;  // by output
    arguments.list_hash = read_list(
        arguments.list, [&](const std::string& id) { return arguments.shard.contains(id); },
        [&](BatchFile&& file) {
            complete_model(file, arguments, given);
            if (!ids.insert(file.name).second) throw InputError("", file.name, "two models have this id");
            const auto [owner, is_new] = owners.emplace(file.out_name, file.name);
            if (!is_new)
                throw InputError("", file.name,
                                 "has the same output as " + owner->second + ": " + file.out_name);
            files.push_back(std::move(file));
        });
    std::sort(files.begin(), files.end(), [](const BatchFile& a, const BatchFile& b) {
        return a.bytes != b.bytes ? a.bytes > b.bytes : a.name < b.name;
    });
    return files;
}

ExitCode run_batch(const std::vector<BatchFile>& files, const RunArguments& arguments,
                   const BatchContext& work, const std::function<void(const std::string&)>& print) {
    return BatchRun(files, arguments, work, print).run();
}

}  // namespace faqem::cli
