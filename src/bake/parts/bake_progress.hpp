#pragma once
/// \file
/// Progress, cancellation and the time limit of one call of bake().

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/time_limit.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Calls the progress callback, only on the thread that constructs it.
class BakeProgress {
public:
    /// \param options  threads, progress callback and time limit; must outlive this
    explicit BakeProgress(const Options& options) : options_(options) {}

    /// Calls the progress callback.
    /// \param fraction  of the phase, 0 to 1
    /// \throws engine::Cancelled if the callback cancels or the time is over, and whatever it throws
    void report(Phase phase, double fraction) {
        phase_ = phase;
        fraction_ = fraction;
        check().now();
    }
    /// Begins a phase that run_blocks() goes through.
    /// \param elements  of all loops of the phase
    void begin(Phase phase, std::size_t elements) {
        phase_ = phase;
        fraction_ = 0;
        done_ = 0;
        total_ = static_cast<double>(elements);
    }
    /// parallel_blocks() over some elements of the phase that was begun. Reports progress.
    /// \param work  called as work(begin, end, check_cancelled)
    template <class Work>
    void run_blocks(std::size_t size, std::size_t block, const Work& work) {
        report(phase_, std::min(1.0, done_ / total_));
        const std::thread::id caller = std::this_thread::get_id();
        std::atomic<std::size_t> finished{0};
        parallel_blocks(size, block, workers(),
                        [&](std::size_t begin, std::size_t end, CancellationCheck check_cancelled) {
                            work(begin, end, check_cancelled);
                            const auto now = static_cast<double>(finished += end - begin);
                            // The callback is called on this thread only, after each block.
                            if (std::this_thread::get_id() == caller)
                                fraction_ = std::min(1.0, (done_ + now) / total_);
                        });
        done_ += static_cast<double>(size);
    }

    /// Check for loops on the calling thread. It passes on the progress that was reported last.
    CancellationCheck check() { return CancellationCheck(monitor_); }
    Workers workers() { return {options_.threads, check()}; }
    /// Options::threads.
    std::uint32_t threads() const { return options_.threads; }

    /// Does work that Options::max_seconds may stop; other work is always completed.
    /// \return false if the time was over before the work was complete
    /// \throws engine::Cancelled if the callback cancels, and whatever it and `work` throw
    template <class Work>
    bool run_in_time(const Work& work) {
        bool is_complete = true;
        monitor_.set_deadline(deadline_);
        try {
            check().now();
            work();
        } catch (const engine::Cancelled& stopped) {
            if (stopped.reason == StopReason::cancelled) throw;
            is_complete = false;
        }
        monitor_.set_deadline(no_deadline);
        return is_complete;
    }

private:
    const Options& options_;
    Deadline deadline_ = deadline_of(options_);
    double done_ = 0, total_ = 1;  // elements of the phase
    // Arguments of the next call of the callback.
    Phase phase_ = Phase::map;
    double fraction_ = 0;
    engine::ProgressMonitor monitor_{
        [this] { return options_.progress ? options_.progress(phase_, fraction_) : Continue::yes; }};
};

}  // namespace faqem::detail
