#pragma once
/// \file
/// How much memory a batch may use at once.

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>

#include "faqem/options.hpp"

namespace faqem::cli {

/// An upper estimate of what simplify takes at its peak, from the size of the files alone, bytes. It goes by
/// what a face takes at least in a file of that format, and by what the presets were measured to take.
/// \param bytes  of the model and the files it refers to
std::uint64_t estimated_peak_memory_of_file(const std::filesystem::path& model, std::uint64_t bytes,
                                            const Options& options);

/// Lets work begin while what has begun fits. What does not fit at all is done while nothing else is.
class MemorySemaphore {
public:
    explicit MemorySemaphore(std::uint64_t limit) : limit_(limit) {}

    /// Waits. To be called in the order in which the work is to begin: a later caller does not overtake.
    void acquire(std::uint64_t bytes);
    void release(std::uint64_t bytes);

private:
    std::uint64_t limit_, used_ = 0;
    std::mutex mutex_, order_mutex_;
    std::condition_variable changed_;
};

}  // namespace faqem::cli
