#pragma once
/// \file
/// Definition of faqem_asset.

#include <cstddef>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "capi/c_result.hpp"
#include "capi/guard.hpp"
#include "faqem/bake.hpp"
#include "faqem/faqem_asset.h"

namespace faqem::capi {

/// What saving an asset left out. Several threads may call all functions at once.
class SaveWarnings {
public:
    void add(const std::vector<std::string>& texts) {
        const std::lock_guard lock(mutex_);
        texts_.insert(texts_.end(), texts.begin(), texts.end());
    }

    std::size_t size() const {
        const std::lock_guard lock(mutex_);
        return texts_.size();
    }

    /// \return a text that stays valid; null if there are fewer
    const char* at(std::size_t index) const {
        const std::lock_guard lock(mutex_);
        return index < texts_.size() ? texts_[index].c_str() : nullptr;
    }

private:
    mutable std::mutex mutex_;
    std::deque<std::string> texts_;  // not a vector, which would move the texts
};

/// Adds the warnings of options that have no effect on a model.
void warn_of_idle_options(const faqem_options* options, const Asset& source, Report& report);

}  // namespace faqem::capi

struct faqem_asset {
    explicit faqem_asset(faqem::Asset made) : asset(std::move(made)) {}
    /// \throws CancelledError  the run was cancelled
    explicit faqem_asset(faqem::SimplifiedAsset simplified,
                         double error = std::numeric_limits<double>::quiet_NaN())
        : asset(std::move(simplified.asset)),
          stored_report(simplified.report),
          histories(std::move(simplified.histories)),
          level_error(error) {
        if (simplified.report.stop == faqem::StopReason::cancelled) throw faqem::capi::CancelledError();
    }

    faqem::Asset asset;
    std::optional<faqem::capi::ReportWithJson> stored_report = {};  ///< set for simplified assets
    std::vector<faqem::CollapseHistory> histories = {};  ///< one per part, or empty if not recorded
    double level_error = std::numeric_limits<double>::quiet_NaN();  ///< NaN if the asset is not a level
    faqem::capi::SaveWarnings save_warnings = {};
};

namespace faqem::capi {

/// Returns an element, for example a part; null if `asset` is null or has no such element.
template <class Element>
const Element* find(const faqem_asset* asset, std::vector<Element> Asset::*all, std::size_t index) {
    return asset && index < (asset->asset.*all).size() ? &(asset->asset.*all)[index] : nullptr;
}

/// Converts to the C++ enumeration.
/// \throws OptionError  unknown enumerator
inline Overwrite to_overwrite(faqem_overwrite overwrite) {
    if (overwrite != FAQEM_OVERWRITE_NO && overwrite != FAQEM_OVERWRITE_YES)
        throw OptionError("overwrite: unknown enumerator");
    return overwrite == FAQEM_OVERWRITE_YES ? Overwrite::yes : Overwrite::no;
}

}  // namespace faqem::capi
