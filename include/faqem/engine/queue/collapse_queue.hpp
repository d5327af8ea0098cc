#pragma once
/// \file
/// The concept of collapse queues, and defaults for its optional parts.

#include <concepts>
#include <cstddef>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

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
    // True if pop() returns the cheapest pair and all costs are current. Otherwise the queue tolerates outdated
    // costs: a collapse usually increases the costs of the pairs around it, and these are computed again when
    // the pair is popped.
    { Q::is_exact } -> std::convertible_to<bool>;
    // Marks the cost of a pair as outdated. Returns false if set() must be called instead.
    { queue.mark_stale(pair) } -> std::same_as<bool>;
    // The cost of a popped pair is at most this factor times the lowest cost in the queue.
    { const_queue.approximation_factor() } -> std::same_as<double>;
    // Sets the expected number of pairs at the target.
    {queue.set_target(pairs)};
};

/// Base of queues: defaults for an exact queue whose strategy does not depend on the target.
struct QueueDefaults {
    static constexpr bool is_exact = true;
    static constexpr bool mark_stale(Index) { return false; }
    static constexpr double approximation_factor() { return 1; }
    static void set_target(std::size_t) {}
};

}  // namespace engine
FAQEM_NAMESPACE_END
