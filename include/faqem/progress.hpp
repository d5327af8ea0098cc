#pragma once
/// \file
/// Progress and cancelling.

#include <functional>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN

/// The phases of the work, in order.
enum class Phase { load, weld, simplify, map, bake, save };

/// What a callback answers.
enum class Continue { yes, cancel };

/// Called on the calling thread, after every few thousand operations. The fraction may stay for a while.
/// \param phase     what is being done
/// \param fraction  share of the phase that is done, in [0, 1]
/// An exception thrown by the callback passes through to the caller of faqem.
using Progress = std::function<Continue(Phase phase, double fraction)>;

FAQEM_NAMESPACE_END
