#include "faqem/engine/queue.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <utility>

#include "core/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

static_assert(CollapseQueue<HeapQueue> && CollapseQueue<BucketQueue>);

TEST_CASE("equal costs come out by index, however they went in") {
    HeapQueue queue;
    queue.reserve(6);
    for (const Index pair : {4u, 1u, 5u, 0u, 3u, 2u}) queue.set(pair, pair == 5 ? 1.0 : 7.0);
    CHECK(queue.has_before(2));
    CHECK_FALSE(queue.has_before(1));
    std::vector<Index> order;
    while (!queue.empty()) order.push_back(queue.pop());
    CHECK(order == std::vector<Index>{5, 0, 1, 2, 3, 4});
}

TEMPLATE_TEST_CASE("the queue knows what is in it", "", HeapQueue, BucketQueue) {
    TestType queue;
    queue.reserve(3);
    CHECK(queue.empty());
    CHECK_FALSE(queue.has_before(1));
    queue.set(1, 2.0);
    queue.set(2, 8.0);
    CHECK(queue.contains(1));
    CHECK_FALSE(queue.contains(0));
    CHECK(queue.has_before(4.0));
    CHECK_FALSE(queue.has_before(2.0));
    queue.erase(0);
    CHECK(queue.pop() == 1);
    CHECK_FALSE(queue.contains(1));
    CHECK_FALSE(queue.has_before(4.0));
    queue.erase(2);
    CHECK(queue.empty());
}

TEST_CASE("the heap does what an ordered set does") {
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
            if (queue.has_before(expected.begin()->first)) FAIL("before the first at step " << step);
            if (!queue.has_before(expected.begin()->first + 0.5)) FAIL("first at step " << step);
            if (queue.pop() != expected.begin()->second) FAIL("pop at step " << step);
            expected.erase(expected.begin());
        }
        if (queue.empty() != expected.empty()) FAIL("empty at step " << step);
    }
    while (!expected.empty()) {
        REQUIRE(queue.pop() == expected.begin()->second);
        expected.erase(expected.begin());
    }
    CHECK(queue.empty());
}

TEST_CASE("buckets give out nearly equal costs in the order in which they came to their level") {
    BucketQueue queue;
    queue.reserve(6);
    for (const Index pair : {4u, 1u, 5u}) queue.set(pair, 1 + pair * 1e-4);
    queue.set(2, 1.1);
    queue.set(0, 0.0);
    queue.set(3, 1e300);  // beyond what a float holds
    queue.set(1, 1.1);    // later than 4 and 5 now, but here before 2
    std::vector<Index> order;
    while (!queue.empty()) order.push_back(queue.pop());
    CHECK(order == std::vector<Index>{0, 4, 5, 1, 2, 3});
}

TEST_CASE("buckets stay in a block while it has pairs on the level") {
    BucketQueue queue(2);  // blocks of four pairs
    queue.reserve(12);
    for (const Index pair : {9u, 1u, 5u, 10u, 2u, 6u}) queue.set(pair, 1 + 0.02 * pair);
    queue.set(3, 2.0);
    std::vector<Index> order;
    for (int i = 0; i < 3; ++i) order.push_back(queue.pop());
    // Block 2 is open. What comes in below its level there is next, elsewhere when the block is done.
    queue.set(7, 0.1);
    queue.set(0, 0.1);
    queue.set(8, 0.2);
    while (!queue.empty()) order.push_back(queue.pop());
    CHECK(order == std::vector<Index>{5, 6, 9, 8, 10, 0, 7, 1, 2, 3});
}

TEST_CASE("buckets go block by block through the lowest levels where these were made one") {
    const std::vector<double> costs = {4, 1, 64, 2, 8, 16, 1, 128};
    const auto order = [&](std::size_t merged) {
        BucketQueue queue(2);  // blocks of four pairs
        queue.reserve(costs.size());
        for (Index pair = 0; pair < costs.size(); ++pair) queue.set(pair, costs[pair]);
        queue.merge_lowest(merged);
        std::vector<Index> popped;
        while (!queue.empty()) popped.push_back(queue.pop());
        return popped;
    };
    CHECK(order(0) == std::vector<Index>{6, 1, 3, 0, 4, 5, 2, 7});
    // 1, 1, 2, 4 are below the level of 8, which takes them in.
    CHECK(order(4) == std::vector<Index>{6, 4, 1, 3, 0, 5, 2, 7});
}

TEST_CASE("in one block buckets never give out a cost that is a sixty-fourth above another") {
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
            cost[pair] = std::pow(10.0, random.between(-12, 3));
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
                    FAIL("a lower one is left at step " << step);
            }
        }
        REQUIRE(queue.empty() == (size == 0));
        REQUIRE(queue.contains(pair) == (cost[pair] >= 0));
    }
}

TEMPLATE_TEST_CASE("reserve forgets what was in the queue", "", HeapQueue, BucketQueue) {
    TestType queue;
    queue.reserve(2);
    queue.set(1, 1);
    queue.reserve(2);
    CHECK(queue.empty());
    queue.erase(1);
    queue.set(0, 3);
    CHECK(queue.pop() == 0);
}
