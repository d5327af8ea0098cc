#include "cli/batch/process_file.hpp"

#include <malloc.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "asset/model_files.hpp"
#include "cli/files/file_stamp.hpp"
#include "cli/files/output_file.hpp"
#include "cli/memory/memory_estimate.hpp"
#include "cli/memory/memory_limit.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/json.hpp"
#include "cli/process/rejection.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/error.hpp"
#include "result/simplify_file.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// Acquires memory from the semaphore and releases it at destruction.
class MemoryReservation {
public:
    MemoryReservation(MemorySemaphore& semaphore, std::uint64_t bytes)
        : semaphore_(semaphore), bytes_(bytes), request_(semaphore.acquire(bytes)) {}
    ~MemoryReservation() { semaphore_.release(bytes_); }
    MemoryReservation(const MemoryReservation&) = delete;
    MemoryReservation& operator=(const MemoryReservation&) = delete;

    bool was_shared() const { return semaphore_.was_shared(request_); }

private:
    MemorySemaphore& semaphore_;
    std::uint64_t bytes_, request_;
};

/// A request for this many bytes is granted only when no other memory is in use.
constexpr std::uint64_t all_memory = std::numeric_limits<std::uint64_t>::max();

/// Returns whether the output file was written by this batch: it matches the record, or an interrupted run
/// began it.
bool is_own_result(const BatchFile& file, const std::optional<BatchEntry>& entry) {
    return entry && (entry->result.empty() || entry->result == modification_stamp({file.out}));
}

struct Result {
    ExitCode code = exit_ok;
    std::string status, message;
    std::uint64_t faces_in = 0, faces_out = 0;
    std::vector<std::string> warnings;
};

Result skipped_result(const BatchEntry& entry) {
    return {exit_ok, "skipped", "up to date", entry.faces_in, entry.faces_out, {}};
}

Result cancelled_result() { return {exit_cancelled, "cancelled", "cancelled", 0, 0, {}}; }

/// \param overwrite  set to yes when the result is about to be written
Result simplify_and_save(const BatchFile& file, const BatchContext& work, BatchEntry entry,
                         Overwrite& overwrite) {
    SimplifiedAsset simplified = detail::simplify_file(file.in, work.options, [&](const Asset& source) {
        check_strictness(source, file.in, work.strictness);
    });
    const Report& report = simplified.report;
    if (report.stop == StopReason::cancelled) return cancelled_result();
    Result result = {exit_ok, "done", "", report.faces_in, report.faces_out, report.warnings};
    result.code = rejection_code(report, work.strict_target);
    if (result.code != exit_ok) {
        result.status = "failed";
        result.message = rejection_message(result.code, file.in, file.out, report);
        return result;
    }
    entry.faces_in = report.faces_in;
    entry.faces_out = report.faces_out;
    work.record.add(file.out_name, entry);
    detail::save_result(simplified, file.out, work.options, std::exchange(overwrite, Overwrite::yes));
    result.warnings = report.warnings;
    entry.result = modification_stamp({file.out});
    work.record.add(file.out_name, entry);
    return result;
}

Result failed_result(const std::exception& problem) {
    return {exit_code_of(problem), "failed", message_of(problem), 0, 0, {}};
}

/// Whether the memory of the process is used by other models at the same time.
enum class Sharing { allowed, none };

/// Simplifies a model, in the case of Sharing::allowed as soon as there is memory for it.
/// \param overwrite  whether the result may exist; set to yes when it is about to be written
/// \param watch      reset after waiting for memory, so that it measures the work alone
/// \throws std::bad_alloc if memory is exhausted while other models use it
Result try_process(const BatchFile& file, const BatchContext& work, Sharing sharing, Overwrite& overwrite,
                   detail::Stopwatch& watch) try {
    if (is_interrupted()) return cancelled_result();
    if (!file.problem.empty()) throw ReadError(file.in.string(), "", file.problem);
    std::vector<fs::path> inputs = detail::referenced_files(file.in, detail::References::readable);
    inputs.insert(inputs.begin(), file.in);
    const BatchEntry entry = {modification_stamp(inputs), work.options_key, "", 0, 0};
    const std::optional<BatchEntry> before =
        work.resume ? work.record.find(file.out_name) : std::optional<BatchEntry>();
    const bool is_own = is_own_result(file, before);
    if (is_own && !before->result.empty() && before->inputs == entry.inputs &&
        before->options == entry.options)
        return skipped_result(*before);
    std::error_code error;
    fs::create_directories(file.out.parent_path(), error);
    if (is_own) overwrite = Overwrite::yes;
    check_output(file.out, overwrite);
    const std::uint64_t process_limit = std::max(work.memory.limit(), min_process_memory);
    std::optional<MemoryReservation> reservation;
    if (sharing == Sharing::allowed)
        reservation.emplace(work.memory, estimated_document_memory(file.in, process_limit));
    const std::uint64_t loading = estimated_model_memory(file.in, process_limit);
    reservation.reset();  // a model that holds memory while it waits for more might wait forever
    require_memory(file.in, loading, process_limit);
    if (sharing == Sharing::allowed) {
        reservation.emplace(
            work.memory,
            loading + estimated_work_memory(file.in, detail::total_file_size(inputs), work.options));
        if (is_interrupted()) return cancelled_result();
    }
    watch = {};
    try {
        return simplify_and_save(file, work, entry, overwrite);
    } catch (const std::bad_alloc& problem) {
        if (!reservation || reservation->was_shared()) throw;
        return failed_result(problem);
    }
} catch (const std::bad_alloc& problem) {
    if (sharing == Sharing::allowed) throw;
    return failed_result(problem);
} catch (const std::exception& problem) {
    return failed_result(problem);
}

/// One attempt at a model; see process_batch_file() and try_process().
ExitCode process(const BatchFile& file, const BatchContext& work, Sharing sharing, Overwrite& overwrite,
                 std::string& line) {
    detail::Stopwatch watch;
    const Result result = try_process(file, work, sharing, overwrite, watch);
    line = json_line({{"path", file.name},
                      {"result", file.out_name},
                      {"status", result.status},
                      {"code", static_cast<int>(result.code)},
                      {"faces_in", result.faces_in},
                      {"faces_out", result.faces_out},
                      {"seconds", watch.seconds()},
                      {"message", result.message},
                      {"warnings", result.warnings}});
    return result.code;
}

}  // namespace

ExitCode process_batch_file(const BatchFile& file, const BatchContext& work, std::string& line) {
    Overwrite overwrite = work.overwrite;
    try {
        return process(file, work, Sharing::allowed, overwrite, line);
    } catch (const std::bad_alloc&) {
        // The memory belongs to the whole process: another model may have used most of it.
    }
    const MemoryReservation alone(work.memory, all_memory);
    malloc_trim(0);
    return process(file, work, Sharing::none, overwrite, line);
}

}  // namespace faqem::cli
