#pragma once
/// \file
/// How far the collapse loop is on its way to the target.

#include <algorithm>
#include <cstddef>
#include <functional>

#include "faqem/engine/loop_options.hpp"
#include "faqem/export.hpp"
#include "faqem/progress.hpp"

FAQEM_ENGINE_BEGIN

/// Progress of one run of the collapse loop.
class LoopProgress {
public:
    /// \param faces  face count at the start
    void start(const LoopOptions& options, std::size_t faces) {
        callback_ = options.progress;
        first_ = faces;
        target_ = options.target_faces;
    }

    std::size_t target_faces() const { return target_; }

    /// Calls LoopOptions::progress, if it is set.
    /// \param faces  current face count
    Continue report(std::size_t faces) const {
        if (!callback_) return Continue::yes;
        const double done = static_cast<double>(first_ - faces);
        const double all = static_cast<double>(first_ - std::min(target_, first_));
        return callback_(all > 0 ? std::min(done / all, 1.0) : 1.0);
    }

private:
    std::function<Continue(double)> callback_;
    std::size_t first_ = 0, target_ = 0;
};

FAQEM_ENGINE_END
