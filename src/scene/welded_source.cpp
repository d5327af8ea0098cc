#include "scene/welded_source.hpp"

#include <cstddef>
#include <utility>

#include "asset/finest_level.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/rounding_weld.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/simplify/presets.hpp"

namespace faqem::detail {
namespace {

bool welds_equal_positions_only(const Options& options) {
    return options.topology.weld == Weld::by_position && !options.topology.weld_distance &&
           settings(options).weld_distance == 0;
}

}  // namespace

WeldedSource::WeldedSource(const Asset& given, const Options& options) : source_(given) {
    if (std::optional<FinestLevel> finest = finest_level(given)) {
        copy_ = std::move(finest->asset);
        if (!finest->warning.empty()) warnings_.push_back(std::move(finest->warning));
    }
    if (!welds_equal_positions_only(options)) return;
    const Stopwatch watch;
    for (std::size_t p = 0; p < given.parts.size(); ++p) {
        const Part& part = asset().parts[p];
        const RoundingWeld found = find_rounding_weld(part.positions, part.triangles, given.precision);
        for (const std::string& message : found.messages)
            warnings_.push_back(part_title(given, p) + ": " + message);
        if (found.representative.empty()) continue;
        if (!copy_) copy_ = given;
        found.apply(copy_->parts[p].positions);
    }
    seconds_ = watch.seconds();
}

void WeldedSource::add_to(Report& report) const {
    report.warnings.insert(report.warnings.begin(), warnings_.begin(), warnings_.end());
    report.seconds.weld += seconds_;
    report.seconds.simplify += seconds_;
    report.seconds.total += seconds_;
}

}  // namespace faqem::detail
