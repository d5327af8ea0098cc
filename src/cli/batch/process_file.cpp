#include "cli/batch/process_file.hpp"

#include <exception>
#include <optional>
#include <vector>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "cli/referenced_files.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_file.hpp"
#include "cli/simplify_model.hpp"

namespace faqem::tool {

namespace {

namespace fs = std::filesystem;

/// A share of the memory, given back at the end.
class Share {
public:
    Share(MemoryGate& gate, std::uint64_t bytes) : gate_(gate), bytes_(bytes) { gate_.enter(bytes_); }
    ~Share() { gate_.leave(bytes_); }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

private:
    MemoryGate& gate_;
    std::uint64_t bytes_;
};

/// Whether the result is what the record says, or was left behind by a run that was cut off.
bool is_ours(const BatchFile& file, const std::optional<BatchEntry>& entry) {
    return entry && (entry->result.empty() || entry->result == stamp_of({file.out}));
}

struct Result {
    ExitCode code = exit_ok;
    std::string status, message;
    std::uint64_t faces_in = 0, faces_out = 0;
    std::vector<std::string> warnings;
};

Result done_before(const BatchEntry& entry) {
    return {exit_ok, "skipped", "unchanged since it was done", entry.faces_in, entry.faces_out, {}};
}

Result cancelled() { return {exit_cancelled, "cancelled", "cancelled", 0, 0, {}}; }

Result make(const BatchFile& file, const BatchWork& work, BatchEntry entry, Overwrite overwrite) {
    Asset source = load_model(file.in, work.strictness);
    Options options = work.options;
    options.bake = bake_for(options.bake, source, file.out);
    LightAsset light = simplify_model(source, file.in, options);
    const Report& report = light.report;
    if (report.stop == StopReason::cancelled) return cancelled();
    Result result = {exit_ok, "done", "", report.faces_in, report.faces_out, source.warnings};
    result.warnings.insert(result.warnings.end(), report.warnings.begin(), report.warnings.end());
    result.code = why_refused(report, work.strict_target);
    if (result.code != exit_ok) {
        result.status = "failed";
        result.message = refusal_text(result.code, file.out, report);
        return result;
    }
    source = {};
    entry.faces_in = report.faces_in;
    entry.faces_out = report.faces_out;
    work.record.add(file.out_name, entry);
    const std::vector<std::string> losses = save(light.asset, file.out, overwrite);
    result.warnings.insert(result.warnings.end(), losses.begin(), losses.end());
    entry.result = stamp_of({file.out});
    work.record.add(file.out_name, entry);
    return result;
}

/// \param watch  begins anew when the waiting for memory is over
Result attempt(const BatchFile& file, const BatchWork& work, detail::Stopwatch& watch) try {
    if (interrupted()) return cancelled();
    std::vector<fs::path> inputs = referred_files(file.in);
    inputs.insert(inputs.begin(), file.in);
    const BatchEntry entry = {stamp_of(inputs), work.options_key, "", 0, 0};
    const std::optional<BatchEntry> before =
        work.resume ? work.record.find(file.out_name) : std::optional<BatchEntry>();
    const bool ours = is_ours(file, before);
    if (ours && !before->result.empty() && before->inputs == entry.inputs && before->options == entry.options)
        return done_before(*before);
    std::error_code error;
    fs::create_directories(file.out.parent_path(), error);
    const Overwrite overwrite = ours ? Overwrite::yes : work.overwrite;
    check_output(file.out, {file.in}, overwrite);
    const Share share(work.memory, predicted_peak(file.in, bytes_of(inputs), work.options));
    if (interrupted()) return cancelled();
    watch = {};
    return make(file, work, entry, overwrite);
} catch (const std::exception& problem) {
    return {exit_code_of(problem), "failed", message_of(problem), 0, 0, {}};
}

}  // namespace

ExitCode do_batch_file(const BatchFile& file, const BatchWork& work, Json& line) {
    detail::Stopwatch watch;
    const Result result = attempt(file, work, watch);
    line = {{"path", file.name},           {"result", file.out_name},
            {"status", result.status},     {"code", static_cast<int>(result.code)},
            {"faces_in", result.faces_in}, {"faces_out", result.faces_out},
            {"seconds", watch.seconds()},  {"message", result.message},
            {"warnings", result.warnings}};
    return result.code;
}

}  // namespace faqem::tool
