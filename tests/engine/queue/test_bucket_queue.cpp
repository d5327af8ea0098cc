#include "faqem/engine/queue/bucket_queue.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("bucket queue: nearly equal costs are popped in the order of insertion") {
    BucketQueue queue;
    queue.reserve(6);
    for (const Index pair : {4u, 1u, 5u}) queue.set(pair, 1 + pair * 1e-4);
    queue.set(2, 1.1);
    queue.set(0, 0.0);
    queue.set(3, 1e300);  // larger than any float
    queue.set(1, 1.1);    // now in the bucket of 2, inserted later
    std::vector<Index> order;
    while (!queue.empty()) order.push_back(queue.pop());
    CHECK(order == std::vector<Index>{0, 4, 5, 2, 1, 3});
}

TEST_CASE("bucket queue: a pair of nearly equal cost is not cheaper, so that a popped pair is not put back") {
    BucketQueue queue;
    queue.reserve(1);
    CHECK_FALSE(queue.has_cheaper(1e300));  // empty
    queue.set(0, 1);
    CHECK_FALSE(queue.has_cheaper(0.9));
    CHECK_FALSE(queue.has_cheaper(1));
    CHECK_FALSE(queue.has_cheaper(1.01));  // in the same bucket
    CHECK(queue.has_cheaper(1.02));        // in the next one: 1 + 1/64 or more
}

TEST_CASE("bucket queue: a popped cost is at most 1/64 above the lowest one") {
    test::Random random(6);
    BucketQueue queue;
    std::vector<double> cost(300, -1);
    queue.reserve(cost.size());
    std::size_t size = 0;
    for (int step = 0; step < 20'000; ++step) {
        const Index pair = random.below(cost.size());
        const double roll = random.unit();
        if (roll < 0.6) {
            size += cost[pair] < 0;
            cost[pair] = std::pow(10.0, random.between(-50, 3));
            queue.set(pair, cost[pair]);
        } else if (roll < 0.7) {
            size -= cost[pair] >= 0;
            cost[pair] = -1;
            queue.erase(pair);
        } else if (size > 0) {
            const double taken = std::exchange(cost[queue.pop()], -1);
            --size;
            REQUIRE(taken >= 0);
            for (const double other : cost) {
                if (other >= 0 && other * (1 + 1.0 / 64) < taken)
                    FAIL("a cheaper pair is left in the queue at step " << step);
            }
        }
        REQUIRE(queue.empty() == (size == 0));
        REQUIRE(queue.contains(pair) == (cost[pair] >= 0));
    }
}
