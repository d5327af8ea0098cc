#pragma once
/// \file
/// What a faqem_asset is inside.

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "capi/guard.hpp"
#include "capi/report.hpp"
#include "faqem/bake.hpp"
#include "faqem/faqem_asset.h"

struct faqem_asset {
    explicit faqem_asset(faqem::Asset made) : asset(std::move(made)) {}
    /// \throws CancelledError
    explicit faqem_asset(faqem::LightAsset light, double error = std::numeric_limits<double>::quiet_NaN())
        : asset(std::move(light.asset)),
          kept(light.report),
          histories(std::move(light.histories)),
          level_error(error) {
        if (light.report.stop == faqem::StopReason::cancelled) throw faqem::c::CancelledError();
    }

    faqem::Asset asset;
    std::optional<faqem::c::KeptReport> kept = {};  ///< of what was made of another
    std::vector<faqem::CollapseHistory> histories =
        {};  ///< one per part, or none where they were not asked for
    double level_error = std::numeric_limits<double>::quiet_NaN();
};

namespace faqem::c {

/// \throws OptionError  it is no enumerator
inline Overwrite overwrite_of(faqem_overwrite overwrite) {
    if (overwrite != FAQEM_OVERWRITE_NO && overwrite != FAQEM_OVERWRITE_YES)
        throw OptionError("overwrite: no such enumerator");
    return overwrite == FAQEM_OVERWRITE_YES ? Overwrite::yes : Overwrite::no;
}

}  // namespace faqem::c
