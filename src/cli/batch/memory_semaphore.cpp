#include "cli/batch/memory_semaphore.hpp"

#include <algorithm>

#include "asset/file_format.hpp"
#include "faqem/options.hpp"

namespace faqem::cli {

namespace {

/// Minimum number of bytes per face in a file, including half a vertex per face.
double min_bytes_per_face(const std::filesystem::path& model) {
    const detail::FileFormat* format = detail::format_by_name(model);
    return format ? format->min_bytes_per_face : 15;
}

/// Peak memory per face, bytes. Measured on meshes of 0.1 and 1 million faces with the history that baking
/// needs, and rounded up.
double peak_bytes_per_face(const Options& options) {
    const double search = options.max_error ? 1.3 : 1;
    switch (options.preset) {
        case Preset::fast:
            return 600 * search;
        case Preset::best:
            return 2000 * search;
        case Preset::balanced:
        case Preset::qem:
        case Preset::paper:
        case Preset::stmw:
            break;
    }
    return 800 * search;
}

}  // namespace

std::uint64_t estimated_peak_memory_of_file(const std::filesystem::path& model, std::uint64_t bytes,
                                            const Options& options) {
    // 64 MB for the process and its threads; 36 bytes per texel of a page for baking several textures.
    double peak = 64e6;
    if (makes_atlas(options.bake.kind)) peak += 36.0 * options.bake.texture_size * options.bake.texture_size;
    const double faces = static_cast<double>(bytes) / min_bytes_per_face(model);
    return static_cast<std::uint64_t>(peak + faces * peak_bytes_per_face(options));
}

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
