#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "cli/batch/memory_semaphore.hpp"
#include "faqem/options.hpp"
#include "support/catch.hpp"

using namespace faqem::cli;

TEST_CASE("MemorySemaphore keeps the total below the limit and grants larger requests exclusively") {
    constexpr std::uint64_t limit = 10;
    MemorySemaphore semaphore(limit);
    std::atomic<std::uint64_t> used{0};
    std::atomic<int> at_work{0};
    std::atomic<bool> too_much{false};
    const auto work = [&](std::uint64_t bytes) {
        for (int i = 0; i < 200; ++i) {
            semaphore.acquire(bytes);
            const std::uint64_t now = used += bytes;
            const int count = ++at_work;
            if (now > limit && count > 1) too_much = true;
            std::this_thread::yield();
            used -= bytes;
            --at_work;
            semaphore.release(bytes);
        }
    };
    std::vector<std::thread> threads;
    for (const std::uint64_t bytes : {3, 4, 9, 25}) threads.emplace_back(work, bytes);
    for (std::thread& thread : threads) thread.join();
    CHECK(!too_much);
}

TEST_CASE("MemorySemaphore tells whether memory was shared") {
    MemorySemaphore semaphore(10);
    const std::uint64_t alone = semaphore.acquire(20);
    CHECK(!semaphore.was_shared(alone));
    semaphore.release(20);
    const std::uint64_t first = semaphore.acquire(4);
    CHECK(!semaphore.was_shared(first));
    const std::uint64_t second = semaphore.acquire(4);
    CHECK(semaphore.was_shared(first));
    CHECK(semaphore.was_shared(second));
    // The other request shared the memory for a part of the time.
    semaphore.release(4);
    CHECK(semaphore.was_shared(second));
    semaphore.release(4);
}
