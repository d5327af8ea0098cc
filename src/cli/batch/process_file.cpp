#include "cli/batch/process_file.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "asset/model_files.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/sha256.hpp"
#include "cli/memory/memory_limit.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/rejection.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/error.hpp"
#include "result/memory_estimate.hpp"
#include "result/simplify_file.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// Limits the memory of the process to what is granted.
class GrantedMemory {
public:
    GrantedMemory(const BatchContext& work, const AskMemory& ask)
        : ask_(ask),
          all_(std::max(work.max_memory, min_process_memory)),
          // Image libraries start a thread per hardware thread, besides those of the model.
          threads_(1 + work.options.threads + detail::thread_count(0)) {
        limit(ask_ ? min_process_memory : all_);
    }

    /// Of the whole batch, bytes.
    std::uint64_t all() const { return all_; }
    void reserve(std::uint64_t bytes) {
        if (ask_) limit(ask_(bytes));
    }
    /// Whether another attempt could get more.
    bool is_part() const { return granted_ < all_; }

private:
    void limit(std::uint64_t bytes) {
        granted_ = std::max(bytes, min_process_memory);
        limit_process_memory(granted_, threads_);
    }

    const AskMemory& ask_;
    std::uint64_t all_, threads_, granted_ = 0;
};

/// Whether a batch has written the file that is there: it is the recorded one, or an attempt without an end changed it.
bool is_own_result(const EarlierResult& earlier, const std::string& present) {
    return present == earlier.written ||
           (earlier.replaced && (present.empty() || present != *earlier.replaced));
}

Json cancelled_line() { return batch_line(exit_cancelled, "cancelled", "cancelled"); }

/// \param overwrite  set to yes when the result is about to be written
Json simplify_and_save(const BatchFile& file, const BatchContext& work, const std::string& inputs,
                       Overwrite& overwrite) {
    const Options& options = file.options ? *file.options : work.options;
    SimplifiedAsset simplified = detail::simplify_file(
        file.in, options, [&](const Asset& source) { check_strictness(source, file.in, work.strictness); });
    const Report& report = simplified.report;
    if (report.stop == StopReason::cancelled) return cancelled_line();
    const auto rejected = rejection(report, work.strict_target, file.in, file.out);
    Json line = batch_line(rejected ? rejected->code : exit_ok, rejected ? "failed" : "done",
                           rejected ? rejected->what() : "", report.faces_in, report.faces_out);
    if (!rejected) {
        detail::save_result(simplified, file.out, options, std::exchange(overwrite, Overwrite::yes));
        std::error_code error;
        line["record"] = {{"bytes", fs::file_size(file.out, error)},
                          {"input_bytes", report.bytes_in},
                          {"inputs", inputs},
                          {"written", modification_stamp({file.out})},
                          {"peak_rss_bytes", process_memory()},
                          {"time_limit", report.stop == StopReason::reached_time_limit}};
    }
    line["warnings"] = report.warnings;
    return line;
}

/// \param overwrite  whether the result may exist; set to yes when it is about to be written
/// \param watch      reset after waiting for memory, so that it measures the work alone
/// \throws whatever makes the model fail
Json try_process(const BatchFile& file, const BatchContext& work, GrantedMemory& memory, Overwrite& overwrite,
                 detail::Stopwatch& watch) {
    if (!file.problem.empty()) throw ReadError(file.in.string(), "", file.problem);
    if (!file.hash.empty() && model_hash(file.in) != file.hash)
        throw InputError(file.in.string(), "", "is not the model of the list: its SHA-256 is another one");
    std::vector<fs::path> inputs = detail::referenced_files(file.in, detail::References::readable);
    inputs.insert(inputs.begin(), file.in);
    const std::string stamp = modification_stamp(inputs);
    if (file.earlier) {
        const EarlierResult& earlier = *file.earlier;
        const std::string present = modification_stamp({file.out});
        if (!present.empty() && present == earlier.written && stamp == earlier.inputs &&
            file.options_id == earlier.options)
            return batch_line(exit_ok, "skipped", "up to date", earlier.faces_in, earlier.faces_out);
        if (is_own_result(earlier, present)) overwrite = Overwrite::yes;
    }
    std::error_code error;
    fs::create_directories(file.out.parent_path(), error);
    check_output(file.out, overwrite, "--resume skips what is up to date, --force overwrites it");
    memory.reserve(detail::estimated_document_memory(file.in, memory.all()));
    const std::uint64_t loading = detail::estimated_model_memory(file.in, memory.all());
    require_memory(file.in, loading, memory.all());
    memory.reserve(loading + detail::estimated_work_memory(file.in, detail::total_file_size(inputs),
                                                           file.options ? *file.options : work.options));
    if (is_interrupted()) return cancelled_line();
    watch = {};
    return simplify_and_save(file, work, stamp, overwrite);
}

}  // namespace

Json process_batch_file(const BatchFile& file, const BatchContext& work, Overwrite overwrite,
                        const AskMemory& ask_memory) {
    GrantedMemory memory(work, ask_memory);
    reset_peak_memory();
    detail::Stopwatch watch;
    Json line;
    try {
        line = try_process(file, work, memory, overwrite, watch);
    } catch (const std::exception& problem) {
        if (memory.is_part() && dynamic_cast<const std::bad_alloc*>(&problem))
            return {{"retry", true}, {"overwrite", overwrite == Overwrite::yes}};
        line = batch_line(exit_code_of(problem), "failed", message_of(problem));
    }
    line["seconds"] = watch.seconds();
    return line;
}

std::string printed_line(const BatchFile& file, const Json& members) {
    Json line = {{"path", file.name}, {"result", file.out_name}};
    line.update(members);
    for (const char* own : {"record", "killed"}) line.erase(own);  // not for users
    return json_line(line);
}

Json batch_line(ExitCode code, const std::string& status, const std::string& message, std::uint64_t faces_in,
                std::uint64_t faces_out) {
    return {{"status", status},
            {"code", static_cast<int>(code)},
            {"faces_in", faces_in},
            {"faces_out", faces_out},
            {"seconds", 0.0},
            {"message", message},
            {"warnings", Json::array()},
            {"record", nullptr}};
}

}  // namespace faqem::cli
