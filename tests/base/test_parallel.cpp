#include "faqem/detail/base/parallel.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "support/catch.hpp"
#include "support/sanitizers.hpp"

using faqem::detail::parallel_blocks;
using faqem::detail::parallel_each;
using faqem::detail::thread_count;

TEST_CASE("parallel_blocks processes each index once, and its blocks do not depend on the threads") {
    for (const std::uint32_t threads : {0u, 1u, 2u, 7u}) {
        for (const std::size_t size :
             {std::size_t{0}, std::size_t{1}, std::size_t{99}, std::size_t{100}, std::size_t{1001}}) {
            std::vector<int> touched(size, 0);
            std::vector<std::size_t> end_of((size + 9) / 10, 0);
            parallel_blocks(size, 10, threads, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++touched[i];
                end_of[begin / 10] = end;
            });
            CHECK(std::count(touched.begin(), touched.end(), 1) == static_cast<std::ptrdiff_t>(size));
            parallel_each(size, 10, threads, [&](std::size_t i) { touched[i] += 2; });
            CHECK(std::count(touched.begin(), touched.end(), 3) == static_cast<std::ptrdiff_t>(size));
            for (std::size_t b = 0; b < end_of.size(); ++b) CHECK(end_of[b] == std::min(size, 10 * b + 10));
        }
    }
}

TEST_CASE("parallel_blocks rethrows an exception of a block after all threads have ended") {
    for (const std::uint32_t threads : {1u, 4u}) {
        CHECK_THROWS_WITH(parallel_blocks(1000, 1, threads,
                                          [](std::size_t begin, std::size_t) {
                                              if (begin == 500) throw std::runtime_error("block 500");
                                          }),
                          "block 500");
    }
}

#ifndef FAQEM_SANITIZED

TEST_CASE("parallel_blocks completes with fewer threads when the system cannot start more") {
    const pid_t child = fork();
    if (child == 0) {
        std::uint64_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        // Enough address space for the stacks of a few threads only.
        const rlim_t bytes = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{64} << 20);
        const rlimit limit = {bytes, bytes};
        setrlimit(RLIMIT_AS, &limit);
        std::atomic<int> done{0};
        parallel_blocks(1000, 1, 1000, [&](std::size_t, std::size_t) { ++done; });
        _exit(done == 1000 ? 0 : 1);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
}

#endif

TEST_CASE("zero threads means one per hardware thread") {
    CHECK(thread_count(0) >= 1);
    CHECK(thread_count(3) == 3);
}
