#include "cli/batch/run_shard.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "cli/batch/model_list.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/sha256.hpp"
#include "cli/process/interrupt.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"
#include "faqem/version.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// Attempts that crash, and attempts without an end, after which a model is given up. A machine that goes away is rarely
/// the fault of the model.
constexpr std::uint32_t max_crashes = 2, max_unended = 5;

/// Identifies the options of a model in a record.
std::string short_hash(std::string_view text) { return hexadecimal(sha256(text)).substr(0, 16); }

/// Adds the options of a model, with the names of the command.
void set_own_options(BatchFile& file, const ListedModel& model, GivenOptions given) {
    for (const auto& [name, value] : model.options.items()) {
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

BatchFile file_of(const ListedModel& model, const ShardArguments& arguments, const GivenOptions& given) {
    const auto fail = [&](const std::string& what) {
        throw InputError(arguments.list.string(), model.id, what);
    };
    BatchFile file;
    file.name = model.id;
    file.in = model.input;
    file.bytes = model.bytes;
    file.hash = model.hash;
    file.out_name = model.output.empty() ? default_output(model.id, arguments.extension) : model.output;
    const fs::path out = fs::path(file.out_name).lexically_normal();
    if (out.is_absolute() || out.empty() || *out.begin() == ".." || *out.begin() == ".")
        fail("the output '" + file.out_name + "' is outside the output directory");
    file.out = arguments.out_folder / out;
    if (is_inside(file.in, arguments.out_folder))
        fail("the input " + file.in.string() + " is inside the output directory");
    try {
        if (!model.options.is_null()) set_own_options(file, model, given);
        check_extension(file.out, {".glb", ".gltf", ".vrm", ".obj", ".ply", ".stl"});
    } catch (const OptionError& error) {
        throw OptionError(arguments.list.string() + ": " + model.id + ": " + error.what());
    }
    return file;
}

/// Hash of a file that tells one list from another.
std::string list_hash(const fs::path& list) {
    Sha256 hash;
    std::ifstream in(list, std::ios::binary);
    std::vector<char> piece(std::size_t{1} << 18);
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
        hash.add(
            {reinterpret_cast<const std::uint8_t*>(piece.data()), static_cast<std::size_t>(in.gcount())});
    return hexadecimal(hash.finish());
}

/// Whether a code says that the model itself is the reason, so that another attempt would end in the same way.
bool is_final(ExitCode code) {
    return code != exit_cancelled && code != exit_cannot_write && code != exit_internal;
}

/// The members of a line of process_batch_file() as a record has them.
Json ledger_members(const BatchFile& file, Json line) {
    const Json more = line.value("record", Json());
    line.erase("record");
    line.erase("status");
    line["result"] = file.out_name;
    line["input_bytes"] = file.bytes;
    if (more.is_object()) line.update(more);
    return line;
}

class ShardRun {
public:
    ShardRun(const std::vector<BatchFile>& files, const ShardArguments& arguments, const BatchContext& work,
             const std::function<void(const std::string&)>& print)
        : files_(files),
          print_(print),
          all_options_(short_hash(work.options_key)),
          ledger_(
              arguments.out_folder, arguments.shard,
              {arguments.shard.count, work.options_key, std::string(version()), list_hash(arguments.list)},
              arguments.replaces_run) {
        for (std::size_t i = 0; i < files.size(); ++i) add_model(i, arguments.redoes);
    }

    ExitCode run(const BatchContext& work, const WorkerOptions& workers) {
        const BatchEvents events = {[this](std::size_t i) {
                                        has_begun_[i] = true;
                                        ledger_.begin(key_of(todo_files_[i]));
                                    },
                                    [this](std::size_t i, const Json& line) {
                                        if (has_begun_[i]) return end(todo_files_[i], todo_[i], line);
                                        tries_again_ = true;
                                        return NextStep::go_on;
                                    }};
        has_begun_.assign(todo_.size(), false);
        process_batch(todo_files_, work, workers, events);
        if (tries_again_ || done_ + refused_ + poisoned_ < files_.size()) return exit_try_again;
        ledger_.complete(
            {{"done", done_}, {"refused", refused_}, {"poisoned", poisoned_}, {"models", files_.size()}});
        return exit_ok;
    }

private:
    ModelKey key_of(const BatchFile& file) const {
        return {file.name, file.hash,
                file.options ? short_hash(detail::options_key(*file.options)) : all_options_};
    }

    /// Decides by its history what is to be done with a model.
    void add_model(std::size_t i, bool redoes) {
        const BatchFile& file = files_[i];
        const ModelHistory history = redoes ? ModelHistory() : ledger_.history(key_of(file));
        std::error_code error;
        if (history.end == "done" && fs::file_size(file.out, error) == history.bytes && !error) {
            ++done_;
        } else if (history.end == "refused") {
            ++refused_;
        } else if (history.crashes >= max_crashes || history.unended >= max_unended) {
            poison(file, history.crashes >= max_crashes ? history.reason
                                                        : std::to_string(history.unended) +
                                                              " attempts have begun it and recorded no end");
        } else {
            todo_.push_back(history);
            todo_files_.push_back(file);
            todo_files_.back().alone = history.crashes > 0;
        }
    }

    void poison(const BatchFile& file, const std::string& reason) {
        ++poisoned_;
        ledger_.end(key_of(file), "poisoned", {{"message", reason}});
        print_(json_line({{"path", file.name},
                          {"result", file.out_name},
                          {"status", "poisoned"},
                          {"code", static_cast<int>(exit_internal)},
                          {"message", reason}}));
    }

    NextStep end(const BatchFile& file, ModelHistory& history, const Json& line) {
        const auto code = line.at("code").get<ExitCode>();
        if (code == exit_internal && ++history.crashes < max_crashes) {
            ledger_.end(key_of(file), "crashed", ledger_members(file, line));
            return NextStep::again_alone;
        }
        if (code == exit_internal) {
            ledger_.end(key_of(file), "crashed", ledger_members(file, line));
            poison(file, line.at("message"));
            return NextStep::go_on;
        }
        const std::string event = code == exit_ok ? "done" : is_final(code) ? "refused" : "interrupted";
        ledger_.end(key_of(file), event, ledger_members(file, line));
        if (event == "interrupted")
            tries_again_ = true;
        else
            ++(event == "done" ? done_ : refused_);
        print_(printed_line(file, line));
        // Where one file cannot be written, others cannot either.
        return code == exit_cannot_write ? NextStep::stop : NextStep::go_on;
    }

    const std::vector<BatchFile>& files_;
    const std::function<void(const std::string&)>& print_;
    std::string all_options_;
    Ledger ledger_;
    std::vector<BatchFile> todo_files_;
    std::vector<ModelHistory> todo_;
    std::vector<bool> has_begun_;
    std::uint64_t done_ = 0, refused_ = 0, poisoned_ = 0;
    bool tries_again_ = false;
};

}  // namespace

std::vector<BatchFile> models_of_shard(const ShardArguments& arguments, const GivenOptions& given) {
    std::vector<BatchFile> files;
    std::set<std::string> ids;
    std::map<std::string, std::string> owners;  // by output
    read_list(
        arguments.list, [&](const std::string& id) { return arguments.shard.contains(id); },
        [&](ListedModel&& model) {
            files.push_back(file_of(model, arguments, given));
            if (!ids.insert(model.id).second)
                throw InputError(arguments.list.string(), model.id, "two models have this id");
            const auto [owner, is_new] =
                owners.emplace(files.back().out.lexically_normal().string(), model.id);
            if (!is_new)
                throw InputError(arguments.list.string(), model.id,
                                 "has the same output as " + owner->second + ": " + files.back().out_name);
        });
    std::sort(files.begin(), files.end(), [](const BatchFile& a, const BatchFile& b) {
        return a.bytes != b.bytes ? a.bytes > b.bytes : a.name < b.name;
    });
    return files;
}

ExitCode run_shard(const std::vector<BatchFile>& files, const ShardArguments& arguments,
                   const BatchContext& work, const WorkerOptions& workers,
                   const std::function<void(const std::string&)>& print) {
    return ShardRun(files, arguments, work, print).run(work, workers);
}

}  // namespace faqem::cli
