#include "allocations.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

// Counting is enabled only while a PeakMemory exists, because shared counters slow down threads that allocate
// often.
std::atomic<bool> counting{false};
std::atomic<std::int64_t> held{0}, peak{0};

void* counted(void* memory) {
    if (!memory) throw std::bad_alloc();
    if (counting.load(std::memory_order_relaxed)) {
        const auto size = static_cast<std::int64_t>(malloc_usable_size(memory));
        const std::int64_t now = held.fetch_add(size) + size;
        for (std::int64_t old = peak; now > old && !peak.compare_exchange_weak(old, now);) continue;
    }
    return memory;
}

void release(void* memory) {
    if (counting.load(std::memory_order_relaxed))
        held.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(memory)));
    std::free(memory);
}

void* aligned(std::size_t size, std::align_val_t alignment) {
    const auto step = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}

}  // namespace

void* operator new(std::size_t size) { return counted(std::malloc(size ? size : 1)); }
void* operator new(std::size_t size, std::align_val_t alignment) { return aligned(size, alignment); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace faqem::bench {

PeakMemory::PeakMemory() {
    held = 0;
    peak = 0;
    counting = true;
}

PeakMemory::~PeakMemory() { counting = false; }

std::uint64_t PeakMemory::bytes() const {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(peak, 0));
}

}  // namespace faqem::bench
