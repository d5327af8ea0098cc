#pragma once
/// \file
/// Parallel loop over the blocks of a range. It uses std::thread because ThreadSanitizer reports races
/// inside the packaged oneTBB.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <type_traits>
#include <vector>

#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

using engine::RunContext;

/// Number of threads to use.
/// \param wanted  requested number; 0: one per hardware thread
/// \return at least 1
inline unsigned thread_count(std::uint32_t wanted) {
    return wanted ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

/// State shared by the threads of one parallel_blocks() call: the calling thread and its helpers.
class BlockQueue {
public:
    /// Must be constructed on the calling thread.
    /// \param size   number of elements
    /// \param block  elements per block, at least 1
    BlockQueue(std::size_t size, std::size_t block)
        : size_(size), block_(block), blocks_((size + block - 1) / block) {}

    std::size_t blocks() const { return blocks_; }

    /// Processes blocks until none are left or a thread has failed. Exceptions are stored, not thrown.
    template <class Work>
    void run(Work& work, const RunContext& context) {
        for (std::size_t b; (b = next_.fetch_add(1)) < blocks_;) {
            try {
                const std::size_t begin = b * block_, end = std::min(size_, begin + block_);
                if constexpr (std::is_invocable_v<Work&, std::size_t, std::size_t, const RunContext&>)
                    work(begin, end, context);
                else
                    work(begin, end);
                context.check_now();
            } catch (...) {
                fail();
            }
        }
    }

    /// run() for a helper thread, with a context that stops it after another thread has failed.
    template <class Work>
    void run_helper(Work& work, std::uint32_t threads) {
        const RunContext own(
            threads, [this](Phase, double) { return has_failed_ ? Continue::cancel : Continue::yes; });
        run(work, own);
        const std::lock_guard lock(mutex_);
        --helpers_;
        ended_.notify_one();
    }
    /// Counts a helper thread before it is started (1), or one that could not be started (-1).
    void count_helper(int change) {
        const std::lock_guard lock(mutex_);
        helpers_ += change;
    }

    /// Blocks until all helpers have ended, and checks every 10 ms meanwhile.
    void wait(const RunContext& context) {
        std::unique_lock lock(mutex_);
        while (helpers_ > 0) {
            ended_.wait_for(lock, std::chrono::milliseconds(10));
            if (helpers_ == 0 || has_failed_) continue;
            lock.unlock();
            try {
                context.check_now();
            } catch (...) {
                fail();
            }
            lock.lock();
        }
    }

    /// Rethrows the stored exception, if any: that of the calling thread, or else the first one.
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

private:
    /// Stores the current exception and stops all threads.
    /// \pre called from an exception handler
    void fail() {
        // The calling thread's exception takes precedence over a helper's, which may only be the cancellation
        // that it caused.
        const std::lock_guard lock(mutex_);
        if (!error_ || std::this_thread::get_id() == caller_) error_ = std::current_exception();
        has_failed_ = true;
        next_ = blocks_;
    }

    std::size_t size_, block_, blocks_;
    std::thread::id caller_ = std::this_thread::get_id();
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> has_failed_{false};
    std::mutex mutex_;
    std::condition_variable ended_;
    int helpers_ = 0;
    std::exception_ptr error_;
};

/// Elements per block of loops with little work per element.
inline constexpr std::size_t elements_per_block = 16384;

/// Calls work(begin, end) once for each block of [0, size), in any order and on several threads. The blocks
/// depend on `size` and `block` only, not on the number of threads, so that per-block results that are
/// combined in block order are the same for any number of threads. If the system refuses to start a thread,
/// the loop runs with fewer.
/// \param size     number of elements; 0 is allowed
/// \param block    elements per block, at least 1; the last block may be shorter
/// \param context  used on the calling thread only
/// \param work     called concurrently. Cancellation is checked after each block; a block that takes longer than
///                 some milliseconds accepts the RunContext of its thread as third argument and checks it. It has
///                 as many threads for loops inside the block.
/// \throws the exception of the calling thread or of `context`, or else the first exception of a
///         helper; all threads have ended by then
template <class Work>
void parallel_blocks(std::size_t size, std::size_t block, const RunContext& context, Work&& work) {
    BlockQueue queue(size, block);
    const std::size_t count =
        std::min<std::size_t>(thread_count(context.threads), std::max<std::size_t>(queue.blocks(), 1));
    std::vector<std::thread> helpers;
    helpers.reserve(count);
    try {
        for (std::size_t i = 1; i < count; ++i) {
            queue.count_helper(1);
            helpers.emplace_back([&] { queue.run_helper(work, context.threads); });
        }
    } catch (const std::system_error&) {
        // The system cannot start more threads; the existing ones do all the work.
        queue.count_helper(-1);
    }
    queue.run(work, context);
    queue.wait(context);
    for (std::thread& helper : helpers) helper.join();
    queue.rethrow();
}

/// parallel_blocks() with work(i) for each element i.
template <class Work>
void parallel_each(std::size_t size, std::size_t block, const RunContext& context, Work&& work) {
    parallel_blocks(size, block, context, [&](std::size_t begin, std::size_t end) {
        for (; begin < end; ++begin) work(begin);
    });
}

/// parallel_blocks() that reports a share of a phase.
/// \param from, to  fractions of the phase that are done before and after the loop
/// \param work      called as work(begin, end, context)
template <class Work>
void reported_blocks(std::size_t size, std::size_t block, const RunContext& context, Phase phase, double from,
                     double to, Work&& work) {
    context.report(phase, from);
    std::atomic<std::size_t> finished{0};
    parallel_blocks(size, block, context,
                    [&](std::size_t begin, std::size_t end, const RunContext& block_context) {
                        work(begin, end, block_context);
                        const auto now = static_cast<double>(finished += end - begin);
                        block_context.show(phase, from + (to - from) * now / static_cast<double>(size));
                    });
}

FAQEM_DETAIL_END
