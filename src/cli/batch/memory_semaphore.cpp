#include "cli/batch/memory_semaphore.hpp"

namespace faqem::cli {

std::uint64_t MemorySemaphore::acquire(std::uint64_t bytes) {
    const std::lock_guard order_lock(order_mutex_);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return holders_ == 0 || (used_ <= limit_ && bytes <= limit_ - used_); });
    used_ += bytes;
    ++requests_;
    if (holders_++ == 0) last_alone_ = requests_;
    return requests_;
}

void MemorySemaphore::release(std::uint64_t bytes) {
    {
        const std::lock_guard lock(mutex_);
        used_ -= bytes;
        --holders_;
    }
    changed_.notify_all();
}

bool MemorySemaphore::was_shared(std::uint64_t request) {
    const std::lock_guard lock(mutex_);
    return last_alone_ != request || requests_ != request;
}

}  // namespace faqem::cli
