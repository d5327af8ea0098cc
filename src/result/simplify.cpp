// What users call: simplify() and bake(), with the rules about the size of results.

#include <iterator>
#include <utility>

#include "bake/scene/unencoded_result.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/base/time_limit.hpp"
#include "result/no_larger.hpp"
#include "result/within_bytes.hpp"

namespace faqem {

namespace {

// Adds what is known of the files of the source.
SimplifiedAsset with_source_report(const Asset& source, SimplifiedAsset result) {
    Report& report = result.report;
    report.warnings.insert(report.warnings.begin(), source.warnings.begin(), source.warnings.end());
    report.bytes_in = source.file_bytes;
    return result;
}

}  // namespace

SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options) {
    SimplifiedAsset result = options.max_bytes ? detail::bake_within_bytes(source, simplified, options)
                                               : detail::bake_no_larger(source, simplified, options);
    detail::add_histories(simplified, options, result);
    return with_source_report(source, std::move(result));
}

SimplifiedAsset simplify(const Asset& source, const Options& options) {
    if (options.max_bytes) return with_source_report(source, detail::simplify_within_bytes(source, options));
    const detail::Deadline deadline = detail::deadline_of(options);
    SimplifiedParts simplified = simplify_parts(source, options);
    SimplifiedAsset result =
        detail::bake_no_larger(source, simplified, detail::with_time_left(options, deadline));
    if (options.history == Recording::on) {
        for (SimplifyResult& part : simplified.parts) result.histories.push_back(std::move(part.history));
    }
    return with_source_report(source, std::move(result));
}

}  // namespace faqem
