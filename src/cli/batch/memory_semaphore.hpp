#pragma once
/// \file
/// Limits the memory that the models of a batch use at the same time.

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace faqem::cli {

/// A semaphore that counts bytes. A request above the limit is granted when no other memory is in use.
class MemorySemaphore {
public:
    explicit MemorySemaphore(std::uint64_t limit) : limit_(limit) {}

    std::uint64_t limit() const { return limit_; }

    /// Waits until `bytes` fit into the limit. Requests are granted in the order of the calls. Thread-safe.
    /// \return a number for was_shared()
    std::uint64_t acquire(std::uint64_t bytes);
    /// Returns memory acquired before. Thread-safe.
    void release(std::uint64_t bytes);
    /// Whether other memory was in use at any time since the acquire() that returned `request`, which must
    /// not be released yet. Thread-safe.
    bool was_shared(std::uint64_t request);

private:
    std::uint64_t limit_, used_ = 0;
    std::uint64_t requests_ = 0;    // granted so far
    std::uint64_t holders_ = 0;     // granted and not released
    std::uint64_t last_alone_ = 0;  // last request that was granted when there were no holders
    std::mutex mutex_, order_mutex_;
    std::condition_variable changed_;
};

}  // namespace faqem::cli
