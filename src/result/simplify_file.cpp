#include "result/simplify_file.hpp"

#include <algorithm>
#include <string>

#include "asset/file_format.hpp"
#include "asset/finest_level.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "result/simplify.hpp"

namespace faqem {

namespace fs = std::filesystem;

namespace {

// Whether the run was not cancelled, faces are left, and the result is within Options::max_error.
bool may_be_saved(const Report& report) {
    return report.stop != StopReason::cancelled && report.faces_out > 0 &&
           (!report.max_error || report.max_error->within());
}

}  // namespace

Asset detail::load_triangles(const fs::path& file) {
    Asset asset = load(file);
    const std::string left_out = keep_finest_level(asset);
    if (!left_out.empty()) asset.warnings.push_back(file.string() + ": " + left_out);
    const bool is_empty = std::all_of(asset.parts.begin(), asset.parts.end(),
                                      [](const Part& part) { return part.triangles.empty(); });
    if (is_empty) throw InputError(file.string(), "", "has no triangles");
    return asset;
}

SimplifiedAsset detail::simplify_file(const fs::path& file, const Options& options,
                                      const std::function<void(const Asset&)>& loaded) {
    const engine::RunContext context(options);
    const Stopwatch watch;
    const Asset source = load_triangles(file);
    const double seconds = watch.seconds();
    loaded(source);
    SimplifiedAsset result = with_file_in_errors(file, [&] { return simplify(source, options, context); });
    result.report.seconds.load = seconds;
    result.report.seconds.total += seconds;
    return result;
}

void detail::save_result(SimplifiedAsset& result, const fs::path& file, Overwrite overwrite) {
    const Stopwatch watch;
    const EncodedModel model = encode_model(result.asset, file);
    write_model(model, file.parent_path(), overwrite);
    Report& report = result.report;
    report.bytes_out = model.bytes();
    report.buffer_views = model.views;
    report.warnings.insert(report.warnings.end(), model.losses.begin(), model.losses.end());
    report.seconds.save = watch.seconds();
    report.seconds.total += report.seconds.save;
}

Report simplify(const fs::path& file, const fs::path& out, const Options& options, Overwrite overwrite) {
    Options own = options;
    own.format = detail::written_format(out).format;
    SimplifiedAsset result = detail::simplify_file(file, own, [](const Asset&) {});
    if (may_be_saved(result.report)) detail::save_result(result, out, overwrite);
    return std::move(result.report);
}

}  // namespace faqem
