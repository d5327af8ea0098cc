#pragma once
/// \file
/// The concept of collapse queues.

#include <concepts>
#include <cstddef>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_ENGINE_BEGIN

/// A priority queue of pairs with costs, finite and >= 0; cheapest first. The order of equal costs must be
/// deterministic: it may depend only on the sequence of calls.
template <class Q>
concept CollapseQueue = requires(Q queue, const Q& const_queue, Index pair, double cost, std::size_t pairs) {
    {queue.reserve(pairs)};                  // clears the queue; pairs in [0, pairs) may be inserted
    {queue.set(pair, cost)};                 // inserts the pair or changes its cost
    {queue.erase(pair)};                     // removes the pair; does nothing if it is not in the queue
    { queue.pop() } -> std::same_as<Index>;  // removes and returns the cheapest pair; not empty
    { const_queue.empty() } -> std::same_as<bool>;
    { const_queue.contains(pair) } -> std::same_as<bool>;
    // Whether a pair in the queue would be popped before the pair just popped, if that were inserted again
    // with this cost.
    { const_queue.has_cheaper(cost) } -> std::same_as<bool>;
};

FAQEM_ENGINE_END
