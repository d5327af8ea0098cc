#include "faqem/engine/queue/sweep_queue.hpp"

#include <cmath>
#include <vector>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

std::vector<Index> all_of(SweepQueue& queue) {
    std::vector<Index> order;
    while (!queue.empty()) order.push_back(queue.pop());
    return order;
}

// Pairs with ascending costs, of which nine tenths are to be removed. The first limit is the quantile of
// 0.3 * 0.9^2 of the costs, so that the first round pops about a fourth of the pairs.
SweepQueue ascending(std::size_t pairs) {
    SweepQueue queue;
    queue.reserve(pairs);
    queue.set_target(pairs / 10);
    for (Index pair = 0; pair < pairs; ++pair) queue.set(pair, 1 + pair);
    return queue;
}

}  // namespace

TEST_CASE("sweep queue: a round pops all pairs up to the limit by index") {
    SweepQueue queue;
    queue.reserve(64);
    queue.set_target(2);
    for (Index pair = 0; pair < 64; ++pair) queue.set(pair, pair % 2 ? 1 : 1000);
    queue.set(5, 3);
    std::vector<Index> expected;
    for (Index pair = 1; pair < 64; pair += 2) {
        if (pair != 5) expected.push_back(pair);
    }
    std::vector<Index> first;
    for (std::size_t i = 0; i < expected.size(); ++i) first.push_back(queue.pop());
    CHECK(first == expected);
    CHECK(queue.pop() == 5);  // at most four times the limit
    CHECK(queue.pop() == 0);
}

TEST_CASE("sweep queue: a stale pair is popped in the next round") {
    SweepQueue queue = ascending(160);
    CHECK(queue.pop() == 0);
    CHECK(queue.mark_stale(2));
    CHECK(queue.pop() == 1);
    CHECK(queue.pop() == 3);
    Index last = 3, pair = queue.pop();
    for (; pair > last; pair = queue.pop()) last = pair;
    CHECK(pair == 2);
    CHECK(last >= 32);
    CHECK(last < 48);
    CHECK_FALSE(queue.mark_stale(2));
}

TEST_CASE("sweep queue: pairs above the limit are popped after those below it") {
    SweepQueue queue = ascending(160);
    CHECK(queue.pop() == 0);
    CHECK_FALSE(queue.has_cheaper(1));
    CHECK(queue.has_cheaper(100));
    queue.set(0, 1e9);
    CHECK(all_of(queue).back() == 0);
}

TEST_CASE("sweep queue: near the target the cheapest pair is popped first") {
    test::Random random(3);
    SweepQueue queue;
    queue.reserve(200);
    queue.set_target(100);
    std::vector<double> costs;
    for (Index pair = 0; pair < 200; ++pair) {
        costs.push_back(std::pow(10.0, random.between(-12, 3)));
        queue.set(pair, costs.back());
    }
    const std::vector<Index> order = all_of(queue);
    REQUIRE(order.size() == 200);
    for (std::size_t i = 90; i + 1 < order.size(); ++i)
        CHECK(costs[order[i + 1]] * (1 + 1.0 / 64) > costs[order[i]]);
}

TEST_CASE("sweep queue: few pairs are popped in the order of a bucket queue") {
    test::Random random(6);
    SweepQueue queue(300);
    BucketQueue buckets;
    queue.reserve(300);
    buckets.reserve(300);
    queue.set_target(3);
    for (Index pair = 0; pair < 300; ++pair) {
        const double cost = random.below(50);
        queue.set(pair, cost);
        buckets.set(pair, cost);
    }
    for (int step = 0; step < 5000; ++step) {
        const double roll = random.unit();
        if (roll < 0.45) {
            const Index pair = random.below(300);
            const double cost = random.below(50);
            queue.set(pair, cost);
            buckets.set(pair, cost);
        } else if (roll < 0.6) {
            const Index pair = random.below(300);
            queue.erase(pair);
            buckets.erase(pair);
        } else if (!buckets.empty()) {
            REQUIRE(queue.pop() == buckets.pop());
            CHECK_FALSE(queue.mark_stale(0));
        }
        REQUIRE(queue.empty() == buckets.empty());
        REQUIRE(queue.has_cheaper(25) == buckets.has_cheaper(25));
    }
}

TEST_CASE("sweep queue: each inserted pair is popped once") {
    test::Random random(8);
    for (const std::size_t end : {0u, 40u, 4000u}) {
        SweepQueue queue;
        queue.reserve(10'000);
        queue.set_target(end);
        std::vector<bool> is_in(10'000, false);
        std::size_t size = 0;
        const auto set = [&](Index pair) {
            queue.set(pair, random.unit() < 0.1 ? 1e-60 : std::pow(10.0, random.between(-30, 60)));
            size += !is_in[pair];
            is_in[pair] = true;
        };
        for (Index pair = 0; pair < 10'000; ++pair) set(pair);
        for (int step = 0; !queue.empty(); ++step) {
            const Index popped = queue.pop();
            REQUIRE(is_in[popped]);
            is_in[popped] = false;
            --size;
            const Index pair = random.below(10'000);
            queue.mark_stale(pair);
            if (step % 3 == 0) set(pair);
            if (step % 3 == 1) {
                size -= is_in[pair];
                is_in[pair] = false;
                queue.erase(pair);
            }
            REQUIRE(queue.contains(pair) == is_in[pair]);
            REQUIRE(queue.empty() == (size == 0));
        }
    }
}

TEST_CASE("sweep queue: a pair that is stale for more than 255 rounds is popped in the end") {
    SweepQueue queue;
    queue.reserve(2);
    queue.set(0, 0);
    queue.set(1, 1);
    REQUIRE(queue.pop() == 0);
    for (int round = 0; round < 700; ++round) {
        queue.set(0, 0);
        queue.mark_stale(1);
        REQUIRE(queue.pop() == 0);
    }
    CHECK(queue.pop() == 1);
}
