#pragma once
/// \file
/// A progress bar on stderr.

#include <string_view>

#include "faqem/progress.hpp"

namespace faqem::cli {

enum class Bar { hidden, shown };

/// One line on stderr with the current phase and its progress.
class ProgressBar {
public:
    /// Nothing is drawn if stderr is not a terminal.
    explicit ProgressBar(Bar bar);
    /// Clears the line.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Returns a callback for Options::progress that draws the bar, and cancels the run after a signal. It must not be
    /// called after the end of the bar, which begins with Phase::load.
    Progress callback();
    /// Draws a text instead.
    void show(std::string_view text);
    /// Clears the line, so that other text can be printed.
    void hide();

private:
    /// Draws the bar if the phase or the percentage changed.
    void show(Phase phase, double fraction);

    bool drawn_ = false, shown_;
    Phase phase_ = Phase::load;
    int percent_ = -1;
};

}  // namespace faqem::cli
