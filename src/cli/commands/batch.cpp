#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "asset/scene/messages.hpp"
#include "cli/batch/batch_run.hpp"
#include "cli/batch/run_summary.hpp"
#include "cli/commands/commands.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/protected_files.hpp"
#include "cli/memory/memory_limit.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/profile.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/progress_bar.hpp"
#include "cli/report/batch_page.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/version.hpp"

namespace faqem::cli {

namespace {

struct BatchArguments : SimplifyArguments {
    std::string in, out, format = default_format(), list, shard = "0/1";
    std::uint32_t jobs = 0;
    std::uint64_t max_memory = 0;  ///< bytes; 0: three quarters of machine_memory()
    std::uint64_t max_array = 1000;
    double end_after = 0;  ///< seconds; 0: the default
    bool until_eof = false, resume = false, force = false, new_run = false, missing = false, merge = false;
};

/// Checks before the first model that no result, with the files beside it, is an input of the batch or belongs
/// to one.
void check_outputs_unprotected(const std::vector<BatchFile>& files) {
    std::vector<std::filesystem::path> results;
    for (const BatchFile& file : files) {
        protect_input(file.in);
        results.push_back(file.out);
    }
    check_models_unprotected(results);
}

/// The state that all models share. \param models  their number
BatchContext make_context(const BatchArguments& arguments, std::size_t models) {
    BatchContext work;
    work.options = make_options(arguments.options);
    work.jobs =
        static_cast<std::uint32_t>(std::clamp<std::size_t>(models, 1, detail::thread_count(arguments.jobs)));
    work.end_after = arguments.end_after > 0    ? arguments.end_after
                     : work.options.max_seconds ? 2 * *work.options.max_seconds + 60
                                                : 3600;
    work.until_eof = arguments.until_eof;
    // The records of a list say whose results are in the directory.
    work.overwrite = arguments.force || !arguments.list.empty() ? Overwrite::yes : Overwrite::no;
    const std::string extension = "." + arguments.format;
    work.options.format = format_of_output("model" + extension);
    for (const std::string& idle :
         detail::idle_options(work.options, typed_names(arguments.options), detail::command_spelling))
        std::cerr << "faqem: warning: " << idle << "\n";
    // Processing several files at a time uses the threads better than using several threads per file.
    if (work.options.threads == 0)
        work.options.threads =
            static_cast<std::uint32_t>(std::max<std::size_t>(detail::thread_count(0) / work.jobs, 1));
    work.options.progress = [](Phase, double) { return is_interrupted() ? Continue::cancel : Continue::yes; };
    work.options_key = std::string(version()) + " " + extension + " " + detail::options_key(work.options) +
                       (arguments.strict ? " strict" : "") +
                       (arguments.strict_target ? " strict-target" : "");
    work.strictness = arguments.strictness();
    work.strict_target = arguments.strict_target;
    work.max_memory = arguments.max_memory > 0 ? arguments.max_memory : machine_memory() / 4 * 3;
    return work;
}

/// Prints the lines of models, and how many there are of each status.
class BatchOutput {
public:
    explicit BatchOutput(std::size_t models) : models_(models) { show_count(); }

    void print(const std::string& line) {
        ++counts_[Json::parse(line).at("status").get<std::string>()];
        ++finished_;
        bar_.hide();
        std::cout << line << std::flush;  // so that a reader of a pipe gets each line immediately
        show_count();
    }
    /// \param others  number of files that are no models
    void end(std::size_t others = 0) {
        bar_.hide();
        std::cerr << "faqem: " << detail::pluralized(models_, "model");
        const char* separator = ": ";
        for (const auto& [status, count] : counts_) {
            std::cerr << separator << count << " " << status;
            separator = ", ";
        }
        if (others > 0) std::cerr << "; " << detail::pluralized(others, "other file") << " passed over";
        std::cerr << "\n";
    }

private:
    void show_count() { bar_.show(std::to_string(finished_) + " of " + std::to_string(models_)); }

    std::size_t models_, finished_ = 0;
    std::map<std::string, std::size_t> counts_;  // by status
    ProgressBar bar_{Bar::shown};
};

int run_models(const BatchArguments& arguments, const std::string& out) {
    RunArguments run{arguments.list, out, "." + arguments.format};
    run.shard = parse_shard(arguments.shard);
    run.reads_records = arguments.list.empty() ? arguments.resume : !arguments.force;
    run.replaces_run = arguments.new_run;
    std::size_t others = 0;
    const std::vector<BatchFile> files = arguments.list.empty()
                                             ? plan_batch(arguments.in, out, run.extension, others)
                                             : models_of_shard(run, arguments.options);
    const BatchContext work = make_context(arguments, files.size());
    check_outputs_unprotected(files);
    make_folder(out);
    install_signal_handlers();
    try {
        BatchOutput output(files.size());
        const ExitCode code =
            run_batch(files, run, work, [&](const std::string& line) { output.print(line); });
        output.end(others);
        return code;
    } catch (const WriteError& error) {
        if (arguments.list.empty()) throw;
        std::cerr << "faqem: " << error.what() << "\n";
        return exit_try_again;
    }
}

/// Writes batch.jsonl and batch.html to the directory.
int merge(const std::string& out) {
    std::string lines;
    const RunSummary summary = merge_records(out, [&](const Json& record) { lines += json_line(record); });
    const std::filesystem::path folder = out;
    write_output(folder / "batch.jsonl", lines, Overwrite::yes);
    write_only_output(folder / "batch.html", batch_page(summary), Overwrite::yes);
    for (const auto& [end, count] : summary.counts) std::cout << end << ": " << count << "\n";
    for (const std::string& problem : summary.problems)
        std::cerr << "faqem: " << out << ": " << problem << "\n";
    return summary.problems.empty() ? exit_ok : exit_batch_incomplete;
}

int run(const BatchArguments& arguments) {
    const bool has_list = !arguments.list.empty() || arguments.missing || arguments.merge;
    const std::string& out_of_list = arguments.in.empty() ? arguments.out : arguments.in;
    if ((arguments.in.empty() || arguments.out.empty()) != has_list)
        throw OptionError(has_list ? "with --list, --missing and --merge there is one directory: OUTDIR"
                                   : "two directories are needed: DIR and OUTDIR");
    if (arguments.list.empty() && (arguments.new_run || arguments.shard != "0/1"))
        throw OptionError("--shard and --new-run need --list");
    if (arguments.missing) {
        std::cout << array_options(incomplete_shards(out_of_list), arguments.max_array);
        return exit_ok;
    }
    if (arguments.merge) return merge(out_of_list);
    return run_models(arguments, arguments.list.empty() ? arguments.out : out_of_list);
}

}  // namespace

CommandInfo batch_command() {
    const auto arguments = std::make_shared<BatchArguments>();
    CommandInfo command{"batch",
                        "Simplify all models of a directory, several at a time",
                        {"faqem batch scans simplified --ratio 0.02 --resume >> done.jsonl",
                         "faqem batch parts simplified --format stl --max-error 0.05 --jobs 4"}};
    OptionInfo dir =
        positional("DIR", arguments->in, "Directory of the models, with subdirectories; with --list: none");
    dir.is_required = false;
    command.positionals = {dir};
    add_output(command, "OUTDIR", arguments->out, "Directory for the results; created if necessary");
    command.options.back().is_required = false;  // with --list it is the only directory
    append(
        command.options,
        {format_option(arguments->format),
         number_option("-j,--jobs", "N", arguments->jobs, {.max = 1024},
                       "Models at a time; 0: the number of threads (default)"),
         size_option("--max-memory", arguments->max_memory,
                     "Memory of models that run at the same time, as 8GB; a model that may need "
                     "more runs alone (default: three quarters of the machine's memory)"),
         number_option(
             "--end-after", "S", arguments->end_after, {.min = 1, .max = 1e6},
             "Give up a model after this many seconds; default: twice --max-seconds plus 60, or 3600"),
         flag_option("--resume", arguments->resume,
                     "Skip results that are up to date; redo those that are not"),
         text_option("--list", "FILE", arguments->list, "Simplify the models of a list; of faqem list"),
         text_option("--shard", "I/N", arguments->shard,
                     "Only a part of the list; the first is 0/N; auto: of an array job"),
         rare(flag_option(
             "--until-eof", arguments->until_eof,
             "End as after a signal when standard input ends; for programs that start the batch")),
         rare(flag_option("--new-run", arguments->new_run,
                          "Replace the run of OUTDIR; which had another list, options or N")),
         rare(flag_option("--missing", arguments->missing,
                          "Print options of sbatch for shards of OUTDIR without an end")),
         rare(number_option("--max-array", "N", arguments->max_array, from_one(1e9),
                            "Indices of an array of --missing are below N; default: 1000")),
         rare(flag_option("--merge", arguments->merge,
                          "Write what became of each model of OUTDIR; to its batch.jsonl and batch.html"))});
    append(command.options, table_options(detail::in_batch, arguments->options));
    for (OptionInfo& option : command.options)
        if (option.names.back() == "--threads")
            option.description = "Maximum number of threads per model; 0: all, divided by the jobs (default)";
    append(command.options, strict_options(arguments->strict, arguments->strict_target));
    append(command.options, {profile_option(), builtin_profile_option(), force_option(arguments->force)});
    command.run = [arguments] { return run(*arguments); };
    return command;
}

}  // namespace faqem::cli
