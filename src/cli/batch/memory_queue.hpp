#pragma once
/// \file
/// Limits the memory that the workers of a batch use at the same time.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>

namespace faqem::cli {

/// Requests for memory, granted in their order. A request above the limit is granted when no other memory is in use.
class MemoryQueue {
public:
    explicit MemoryQueue(std::uint64_t limit) : limit_(limit) {}

    std::uint64_t limit() const { return limit_; }

    /// Adds a request. \pre `worker` has no other request and no memory
    void request(std::size_t worker, std::uint64_t bytes) { waiting_.push_back({worker, bytes}); }
    /// Returns the memory of a worker, if it has any.
    void release(std::size_t worker) {
        const auto held = granted_.find(worker);
        if (held == granted_.end()) return;
        used_ -= held->second;
        granted_.erase(held);
    }
    /// Grants the next request if its memory fits. \return its worker, and the bytes
    struct Grant {
        std::size_t worker;
        std::uint64_t bytes;
    };
    std::optional<Grant> grant() {
        if (waiting_.empty()) return std::nullopt;
        const Grant next = waiting_.front();
        const bool fits = used_ <= limit_ && next.bytes <= limit_ - used_;
        if (!fits && !granted_.empty()) return std::nullopt;
        waiting_.pop_front();
        used_ += next.bytes;
        granted_[next.worker] = next.bytes;
        return next;
    }

private:
    std::uint64_t limit_, used_ = 0;
    std::deque<Grant> waiting_;
    std::map<std::size_t, std::uint64_t> granted_;
};

}  // namespace faqem::cli
