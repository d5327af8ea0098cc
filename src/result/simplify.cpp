// What users call: simplify() and bake(), with the rules about the size of results.

#include "result/simplify.hpp"

#include <algorithm>
#include <utility>

#include "bake/scene/unencoded_result.hpp"
#include "result/size_rules.hpp"
#include "scene/simplify_parts.hpp"

namespace faqem {

namespace {

// Adds what is known of the files and images of the source.
SimplifiedAsset with_source_report(const Asset& source, SimplifiedAsset result) {
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
    SimplifiedAsset result = options.max_bytes ? bake_within_bytes(source, simplified, options, context)
                                               : bake_no_larger(source, simplified, options, context);
    add_histories(simplified, options, result);
    return with_source_report(source, std::move(result));
}

SimplifiedAsset detail::simplify(const Asset& source, const Options& options, const RunContext& context) {
    if (options.max_bytes) return with_source_report(source, simplify_within_bytes(source, options, context));
    SimplifiedParts simplified = simplify_parts(source, options, context);
    SimplifiedAsset result = bake_no_larger(source, simplified, options, context);
    if (options.history == Recording::on) {
        for (SimplifyResult& part : simplified.parts) result.histories.push_back(std::move(part.history));
    }
    return with_source_report(source, std::move(result));
}

SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options) {
    return detail::bake(source, simplified, options, engine::RunContext(options));
}

SimplifiedAsset simplify(const Asset& source, const Options& options) {
    return detail::simplify(source, options, engine::RunContext(options));
}

}  // namespace faqem
