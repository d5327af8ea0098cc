#pragma once
/// \file
/// Work on blocks of a range on several threads. std::thread: ThreadSanitizer reports races inside the
/// packaged oneTBB.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace faqem::detail {

/// Number of threads for a request of `wanted` (0: all there are).
inline unsigned thread_count(std::uint32_t wanted) {
    return wanted ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

/// Calls work(begin, end) for consecutive blocks of [0, size), each call once, in any order.
/// Blocks depend on `size` and `block` only, never on the number of threads, so that per-block results can be
/// joined in block order to the same sum anywhere. The first exception is thrown again here. Where the system
/// gives fewer threads, fewer do it.
template <class Work>
void parallel_blocks(std::size_t size, std::size_t block, std::uint32_t threads, Work&& work) {
    const std::size_t blocks = (size + block - 1) / block;
    std::atomic<std::size_t> next{0};
    std::exception_ptr error;
    std::mutex error_mutex;
    auto run = [&] {
        for (std::size_t b; (b = next.fetch_add(1)) < blocks;) {
            try {
                work(b * block, std::min(size, (b + 1) * block));
            } catch (...) {
                const std::lock_guard lock(error_mutex);
                if (!error) error = std::current_exception();
                next = blocks;
            }
        }
    };
    const std::size_t count = std::min<std::size_t>(thread_count(threads), std::max<std::size_t>(blocks, 1));
    std::vector<std::thread> helpers;
    helpers.reserve(count);
    try {
        for (std::size_t i = 1; i < count; ++i) helpers.emplace_back(run);
    } catch (const std::system_error&) {
        // The system gives no more threads: those there are do it all.
    }
    run();
    for (std::thread& helper : helpers) helper.join();
    if (error) std::rethrow_exception(error);
}

}  // namespace faqem::detail
