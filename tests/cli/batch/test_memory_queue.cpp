#include "cli/batch/memory_queue.hpp"
#include "support/catch.hpp"

using faqem::cli::MemoryQueue;

TEST_CASE("memory is granted in the order of the requests, as long as its sum is within the limit") {
    MemoryQueue queue(10);
    queue.request(0, 6);
    queue.request(1, 5);
    queue.request(2, 1);
    REQUIRE(queue.grant()->worker == 0);
    CHECK(!queue.grant());  // 11 bytes; the smaller request waits behind
    queue.release(0);
    CHECK(queue.grant()->worker == 1);
    CHECK(queue.grant()->worker == 2);
    CHECK(!queue.grant());
}

TEST_CASE("a request above the limit is granted when no other memory is in use, and excludes others") {
    MemoryQueue queue(10);
    queue.request(0, 1);
    queue.request(1, ~std::uint64_t{0});
    queue.request(2, 1);
    CHECK(queue.grant()->worker == 0);
    CHECK(!queue.grant());
    queue.release(0);
    CHECK(queue.grant()->worker == 1);
    CHECK(!queue.grant());
    queue.release(1);
    CHECK(queue.grant()->worker == 2);
}
