#include "cli/process/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <string>

#include "cli/process/interrupt.hpp"

namespace faqem::cli {

namespace {

constexpr std::array<std::string_view, 6> phase_names = {"load", "weld", "simplify", "map", "bake", "save"};
constexpr int width = 40;

}  // namespace

ProgressBar::ProgressBar(Bar bar) : shown_(bar == Bar::shown && isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() { hide(); }

void ProgressBar::hide() {
    if (drawn_) std::cerr << "\r\x1b[K" << std::flush;
}

void ProgressBar::show(std::string_view text) {
    drawn_ = shown_;
    if (shown_) std::cerr << "\r\x1b[K" << text << std::flush;
}

Progress ProgressBar::callback() {
    show(Phase::load, 0);
    return [this](Phase phase, double fraction) {
        show(phase, fraction);
        return is_interrupted() ? Continue::cancel : Continue::yes;
    };
}

void ProgressBar::show(Phase phase, double fraction) {
    if (!shown_) return;
    const int percent = fraction > 0 ? static_cast<int>(100 * std::min(fraction, 1.0)) : 0;
    if (phase == phase_ && percent == percent_) return;
    phase_ = phase;
    percent_ = percent;
    const auto full = static_cast<std::size_t>(width * percent / 100);
    show(std::string(phase_names[static_cast<std::size_t>(phase)]) + " [" + std::string(full, '#') +
         std::string(width - full, '.') + "] " + std::to_string(percent) + "%");
}

}  // namespace faqem::cli
