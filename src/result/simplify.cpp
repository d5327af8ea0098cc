// What users call: simplify() and bake(), with the rules about the size of results.

#include "result/simplify.hpp"

#include <algorithm>
#include <utility>

#include "bake/scene/unencoded_result.hpp"
#include "result/size_rules.hpp"
#include "scene/simplify_parts.hpp"

namespace faqem {

namespace {

// The result of `work()`, with what is known of the files and images of the source; an empty one if it was cancelled.
template <class Work>
SimplifiedAsset with_source_report(const Asset& source, const Work& work) {
    SimplifiedAsset result;
    try {
        result = work();
    } catch (const engine::Cancelled&) {
        result.report.stop = StopReason::cancelled;
    }
    Report& report = result.report;
    report.warnings.insert(report.warnings.begin(), source.warnings.begin(), source.warnings.end());
    report.bytes_in = source.file_bytes;
    for (std::size_t i = 0; i < report.images.size(); ++i)
        report.images[i].is_of_source =
            std::any_of(source.images.begin(), source.images.end(),
                        [&](const Image& image) { return image.encoded == result.asset.images[i].encoded; });
    return result;
}

}  // namespace

SimplifiedAsset detail::bake(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                             const RunContext& context) {
    return with_source_report(source, [&] {
        SimplifiedAsset result = options.max_bytes ? bake_within_bytes(source, simplified, options, context)
                                                   : bake_no_larger(source, simplified, options, context);
        add_histories(simplified, options, result);
        return result;
    });
}

SimplifiedAsset detail::simplify(const Asset& source, const Options& options, const RunContext& context) {
    return with_source_report(source, [&] {
        if (options.max_bytes) return simplify_within_bytes(source, options, context);
        SimplifiedParts simplified = simplify_parts(source, options, context);
        SimplifiedAsset result = bake_no_larger(source, simplified, options, context);
        if (options.history == Recording::on)
            for (SimplifyResult& part : simplified.parts) result.histories.push_back(std::move(part.history));
        return result;
    });
}

SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options) {
    return detail::bake(source, simplified, options, engine::RunContext(options));
}

SimplifiedAsset simplify(const Asset& source, const Options& options) {
    return detail::simplify(source, options, engine::RunContext(options));
}

}  // namespace faqem
