#pragma once
/// \file
/// The asset that is simplified: without coarser levels of detail, and with vertices whose positions differ by rounding
/// at one position.

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asset/finest_level.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/rounding_weld.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/options.hpp"
#include "faqem/report.hpp"

namespace faqem::detail {

/// The source or, if it has coarser levels (finest_level()) or positions that differ by rounding, a copy without these
/// levels in which the positions are welded (weld_rounded_positions()). With Weld::none, a weld_distance, and presets
/// that have one, no positions are.
class WeldedSource {
public:
    /// \param given  must have passed check_asset(), and outlive this
    /// Complexity: O(n) expected
    WeldedSource(const Asset& given, const Options& options) : source_(given) {
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

    WeldedSource(const WeldedSource&) = delete;
    WeldedSource& operator=(const WeldedSource&) = delete;

    const Asset& asset() const { return copy_ ? *copy_ : source_; }
    /// Adds the warnings and the time of the constructor to a report.
    void add_to(Report& report) const {
        report.warnings.insert(report.warnings.begin(), warnings_.begin(), warnings_.end());
        report.seconds.weld += seconds_;
        report.seconds.simplify += seconds_;
        report.seconds.total += seconds_;
    }

private:
    static bool welds_equal_positions_only(const Options& options) {
        return options.topology.weld == Weld::by_position && !options.topology.weld_distance &&
               settings(options).weld_distance == 0;
    }

    const Asset& source_;
    std::optional<Asset> copy_;
    std::vector<std::string> warnings_;
    double seconds_ = 0;
};

}  // namespace faqem::detail
