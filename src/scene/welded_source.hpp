#pragma once
/// \file
/// The asset that is simplified: without coarser levels of detail, and with vertices whose positions differ by rounding
/// at one position.

#include <optional>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
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
    WeldedSource(const Asset& given, const Options& options);
    WeldedSource(const WeldedSource&) = delete;
    WeldedSource& operator=(const WeldedSource&) = delete;

    const Asset& asset() const { return copy_ ? *copy_ : source_; }
    /// Adds the warnings and the time of the constructor to a report.
    void add_to(Report& report) const;

private:
    const Asset& source_;
    std::optional<Asset> copy_;
    std::vector<std::string> warnings_;
    double seconds_ = 0;
};

}  // namespace faqem::detail
