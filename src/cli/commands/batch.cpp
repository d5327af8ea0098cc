#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "asset/scene/messages.hpp"
#include "cli/batch/supervisor.hpp"
#include "cli/commands/commands.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/protected_files.hpp"
#include "cli/memory/machine_memory.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/builtin_profiles.hpp"
#include "cli/options/profile.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/progress_bar.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/version.hpp"

namespace faqem::cli {

namespace {

struct BatchArguments : SimplifyArguments {
    std::string in, out, format = default_format();
    std::uint32_t jobs = 0;
    std::uint64_t max_memory = 0;  ///< bytes; 0: three quarters of machine_memory()
    double end_after = 0;          ///< seconds; 0: the default
    bool resume = false, force = false;
};

/// Checks before the first model that no result, with the files beside it, is an input of the batch or belongs
/// to one.
void check_outputs_unprotected(const std::vector<BatchFile>& files, const std::string& out_folder) {
    std::vector<std::filesystem::path> results;
    for (const BatchFile& file : files) {
        protect_input(file.in);
        results.push_back(file.out);
    }
    check_models_unprotected(results);
    check_unprotected(BatchRecord::path_in(out_folder));
}

int run(const BatchArguments& arguments) {
    Options options = make_options(arguments.options);
    const std::string extension = extension_of_format(arguments.format);
    options.format = format_of_output("model" + extension);
    std::size_t others = 0;
    const std::vector<BatchFile> files = plan_batch(arguments.in, arguments.out, extension, others);
    check_outputs_unprotected(files, arguments.out);
    for (const std::string& idle :
         detail::idle_options(options, typed_names(arguments.options), detail::command_spelling))
        std::cerr << "faqem: warning: " << idle << "\n";
    make_folder(arguments.out);
    BatchRecord record(arguments.out);
    const std::uint64_t allowed = arguments.max_memory > 0 ? arguments.max_memory : machine_memory() / 4 * 3;
    install_signal_handlers();
    const std::size_t jobs = std::min<std::size_t>(detail::thread_count(arguments.jobs), files.size());
    // Processing several files at a time uses the threads better than using several threads per file.
    if (options.threads == 0)
        options.threads =
            static_cast<std::uint32_t>(std::max<std::size_t>(detail::thread_count(0) / jobs, 1));
    options.progress = [](Phase, double) { return is_interrupted() ? Continue::cancel : Continue::yes; };
    const std::string key = std::string(version()) + " " + extension + " " + detail::options_key(options) +
                            (arguments.strict ? " strict" : "") +
                            (arguments.strict_target ? " strict-target" : "");
    const BatchContext work = {
        options, key, arguments.strictness(), arguments.strict_target, arguments.resume, allowed, record};
    const double end_after = arguments.end_after > 0 ? arguments.end_after
                             : options.max_seconds   ? 2 * *options.max_seconds + 60
                                                     : 3600;
    std::map<std::string, std::size_t> counts;  // by status
    std::size_t finished = 0;
    ProgressBar bar(Bar::shown);
    const auto show_count = [&] {
        bar.show(std::to_string(finished) + " of " + std::to_string(files.size()));
    };
    show_count();
    const ExitCode code = process_batch(
        files, work,
        {static_cast<std::uint32_t>(jobs), end_after, arguments.force ? Overwrite::yes : Overwrite::no},
        [&](const std::string& line) {
            ++counts[Json::parse(line).at("status").get<std::string>()];
            ++finished;
            bar.hide();
            std::cout << line << std::flush;  // so that a reader of a pipe gets each line immediately
            show_count();
        });
    bar.hide();
    std::cerr << "faqem: " << detail::pluralized(files.size(), "model") << ":";
    const char* separator = " ";
    for (const auto& [status, count] : counts) {
        std::cerr << separator << count << " " << status;
        separator = ", ";
    }
    if (others > 0) std::cerr << "; " << detail::pluralized(others, "other file") << " passed over";
    std::cerr << "\n";
    return code;
}

}  // namespace

CommandInfo batch_command() {
    const auto arguments = std::make_shared<BatchArguments>();
    CommandInfo command{"batch",
                        "Simplify all models of a directory, several at a time",
                        {"faqem batch scans simplified --ratio 0.02 --resume >> done.jsonl",
                         "faqem batch parts simplified --format stl --max-error 0.05 --jobs 4"}};
    command.positionals = {
        positional("DIR", arguments->in, "Directory of the models; subdirectories are included")};
    add_output(command, "OUTDIR", arguments->out, "Directory for the results; created if necessary");
    add_options(command.options,
                {format_option(arguments->format),
                 number_option("-j,--jobs", "N", arguments->jobs, {.max = 1024},
                               "Models at a time; 0: the number of threads (default)"),
                 size_option("--max-memory", arguments->max_memory,
                             "Memory of models that run at the same time, as 8GB; a model that may need "
                             "more runs alone (default: three quarters of the machine's memory)"),
                 number_option("--end-after", "S", arguments->end_after, {.min = 1, .max = 1e6},
                               "Give up a model after this many seconds; default: twice --max-seconds plus "
                               "60, or 3600"),
                 flag_option("--resume", arguments->resume,
                             "Skip results that are up to date; redo those that are not")});
    add_options(command.options, table_options(detail::in_batch, arguments->options));
    for (OptionInfo& option : command.options) {
        if (option.names.back() == "--threads")
            option.description = "Maximum number of threads per model; 0: all, divided by the jobs (default)";
    }
    add_options(command.options, strict_options(arguments->strict, arguments->strict_target));
    add_options(command.options,
                {profile_option(), builtin_profile_option(), force_option(arguments->force)});
    command.run = [arguments] { return run(*arguments); };
    return command;
}

}  // namespace faqem::cli
