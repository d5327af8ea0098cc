#pragma once
/// \file
/// Work on blocks of a range on several threads. std::thread: ThreadSanitizer reports races inside the
/// packaged oneTBB.

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

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::CancellationCheck;

/// Who does the work of a phase: so many threads, of which the calling one asks whether to go on.
struct Workers {
    // Not explicit: where nobody is to be asked, a number says it all.
    Workers(std::uint32_t at_most = 0, CancellationCheck poll_of_caller = {})
        : threads(at_most), check_cancelled(poll_of_caller) {}

    std::uint32_t threads;  ///< at most; 0: all there are
    CancellationCheck check_cancelled;
};

/// Number of threads for a request of `wanted` (0: all there are).
inline unsigned thread_count(std::uint32_t wanted) {
    return wanted ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

/// What the threads of one parallel_blocks() share.
class BlockQueue {
public:
    BlockQueue(std::size_t size, std::size_t block)
        : size_(size), block_(block), blocks_((size + block - 1) / block) {}

    std::size_t blocks() const { return blocks_; }

    /// Works on one block after the other, until there are none left or a thread has failed.
    template <class Work>
    void run(Work& work, CancellationCheck check_cancelled) {
        for (std::size_t b; (b = next_.fetch_add(1)) < blocks_;) {
            try {
                const std::size_t begin = b * block_, end = std::min(size_, begin + block_);
                if constexpr (std::is_invocable_v<Work&, std::size_t, std::size_t, CancellationCheck>) {
                    work(begin, end, check_cancelled);
                } else {
                    work(begin, end);
                    check_cancelled(end - begin);
                }
            } catch (...) {
                fail();
            }
        }
    }

    /// run() on a thread that helps: its poll tells it that another one has failed.
    template <class Work>
    void run_helper(Work& work) {
        engine::ProgressMonitor monitor([this] { return has_failed_ ? Continue::cancel : Continue::yes; });
        run(work, CancellationCheck(monitor));
        const std::lock_guard lock(mutex_);
        --helpers_;
        ended_.notify_one();
    }
    void add_helper() {
        const std::lock_guard lock(mutex_);
        ++helpers_;
    }
    void remove_helper() {
        const std::lock_guard lock(mutex_);
        --helpers_;
    }

    /// Until all helpers have ended; the caller is asked meanwhile.
    void wait(CancellationCheck check_cancelled) {
        std::unique_lock lock(mutex_);
        while (helpers_ > 0) {
            ended_.wait_for(lock, std::chrono::milliseconds(10));
            if (helpers_ == 0 || has_failed_) continue;
            lock.unlock();
            try {
                check_cancelled.now();
            } catch (...) {
                fail();
            }
            lock.lock();
        }
    }

    /// Throws again what was thrown: by the calling thread, or else first.
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

private:
    /// \pre in a handler
    void fail() {
        // A helper that was told to stop comes second, whoever is sooner here.
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
    std::size_t helpers_ = 0;
    std::exception_ptr error_;
};

/// Calls work(begin, end) for consecutive blocks of [0, size), each call once, in any order.
/// Blocks depend on `size` and `block` only, never on the number of threads, so that per-block results can be
/// joined in block order to the same sum anywhere. Where the system gives fewer threads, fewer do it.
/// \param work  one that takes long for a block takes a CancellationCheck as well, and polls it. Elsewhere the operations
///              of a block are as many as its length.
/// \throws what the calling thread throws, and else the first exception; the others stop before that
template <class Work>
void parallel_blocks(std::size_t size, std::size_t block, const Workers& workers, Work&& work) {
    BlockQueue queue(size, block);
    const std::size_t count =
        std::min<std::size_t>(thread_count(workers.threads), std::max<std::size_t>(queue.blocks(), 1));
    std::vector<std::thread> helpers;
    helpers.reserve(count);
    try {
        for (std::size_t i = 1; i < count; ++i) {
            queue.add_helper();
            helpers.emplace_back([&] { queue.run_helper(work); });
        }
    } catch (const std::system_error&) {
        // The system gives no more threads: those there are do it all.
        queue.remove_helper();
    }
    queue.run(work, workers.check_cancelled);
    queue.wait(workers.check_cancelled);
    for (std::thread& helper : helpers) helper.join();
    queue.rethrow();
}

}  // namespace detail
FAQEM_NAMESPACE_END
