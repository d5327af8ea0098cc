#include "faqem/engine/queue/heap_queue.hpp"

#include <set>
#include <utility>

#include "faqem/engine/queue/bucket_queue.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

static_assert(CollapseQueue<HeapQueue>);

TEST_CASE("heap queue: equal costs are popped by index") {
    HeapQueue queue;
    queue.reserve(6);
    for (const Index pair : {4u, 1u, 5u, 0u, 3u, 2u}) queue.set(pair, pair == 5 ? 1.0 : 7.0);
    CHECK(queue.has_cheaper(2));
    CHECK_FALSE(queue.has_cheaper(1));
    std::vector<Index> order;
    while (!queue.empty()) order.push_back(queue.pop());
    CHECK(order == std::vector<Index>{5, 0, 1, 2, 3, 4});
}

TEMPLATE_TEST_CASE("a queue tracks its contents", "", HeapQueue, BucketQueue) {
    TestType queue;
    queue.reserve(3);
    CHECK(queue.empty());
    CHECK_FALSE(queue.has_cheaper(1));
    queue.set(1, 2.0);
    queue.set(2, 8.0);
    CHECK(queue.contains(1));
    CHECK_FALSE(queue.contains(0));
    CHECK(queue.has_cheaper(4.0));
    CHECK_FALSE(queue.has_cheaper(2.0));
    queue.erase(0);
    CHECK(queue.pop() == 1);
    CHECK_FALSE(queue.contains(1));
    CHECK_FALSE(queue.has_cheaper(4.0));
    queue.erase(2);
    CHECK(queue.empty());
}

TEST_CASE("heap queue: agrees with an ordered set") {
    test::Random random(5);
    HeapQueue queue;
    std::set<std::pair<double, Index>> expected;
    std::vector<double> cost(300, -1);
    queue.reserve(cost.size());
    for (int step = 0; step < 20'000; ++step) {
        const Index pair = random.below(cost.size());
        const double roll = random.unit();
        if (roll < 0.55) {
            const double c = random.below(50);  // many ties
            expected.erase({cost[pair], pair});
            expected.insert({c, pair});
            cost[pair] = c;
            queue.set(pair, c);
        } else if (roll < 0.7) {
            expected.erase({cost[pair], pair});
            queue.erase(pair);
        } else if (!expected.empty()) {
            if (queue.has_cheaper(expected.begin()->first))
                FAIL("has_cheaper() is true for the lowest cost at step " << step);
            if (!queue.has_cheaper(expected.begin()->first + 0.5))
                FAIL("has_cheaper() is false above the lowest cost at step " << step);
            if (queue.pop() != expected.begin()->second)
                FAIL("pop() returned the wrong pair at step " << step);
            expected.erase(expected.begin());
        }
        if (queue.empty() != expected.empty()) FAIL("empty() is wrong at step " << step);
    }
    while (!expected.empty()) {
        REQUIRE(queue.pop() == expected.begin()->second);
        expected.erase(expected.begin());
    }
    CHECK(queue.empty());
}

TEMPLATE_TEST_CASE("reserve clears a queue", "", HeapQueue, BucketQueue) {
    TestType queue;
    queue.reserve(2);
    queue.set(1, 1);
    queue.reserve(2);
    CHECK(queue.empty());
    queue.erase(1);
    queue.set(0, 3);
    CHECK(queue.pop() == 0);
}
