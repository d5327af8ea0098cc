#pragma once
/// \file
/// A line on stderr that says how far the work is; only where stderr is a terminal.

#include "faqem/progress.hpp"

namespace faqem::cli {

enum class Bar { hidden, shown };

class ProgressBar {
public:
    /// Nothing is ever drawn when stderr is no terminal.
    explicit ProgressBar(Bar bar);
    /// Wipes the line.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// \param fraction  of the phase, in [0, 1]
    void show(Phase phase, double fraction);

private:
    bool drawn_ = false, shown_;
    Phase phase_ = Phase::load;
    int percent_ = -1;
};

}  // namespace faqem::cli
