#include "cli/batch/memory_queue.hpp"

namespace faqem::cli {

void MemoryQueue::release(std::size_t worker) {
    const auto held = granted_.find(worker);
    if (held == granted_.end()) return;
    used_ -= held->second;
    granted_.erase(held);
}

std::optional<MemoryQueue::Grant> MemoryQueue::grant() {
    if (waiting_.empty()) return std::nullopt;
    const Grant next = waiting_.front();
    const bool fits = used_ <= limit_ && next.bytes <= limit_ - used_;
    if (!fits && !granted_.empty()) return std::nullopt;
    waiting_.pop_front();
    used_ += next.bytes;
    granted_[next.worker] = next.bytes;
    return next;
}

}  // namespace faqem::cli
