#pragma once
/// \file
/// Progress callback and cancellation.

#include <functional>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN

/// Phases of a run, in order.
enum class Phase { load, weld, simplify, map, bake, save };

/// Return value of the progress callback.
enum class Continue { yes, cancel };

/// Progress callback. It is called on the thread that called faqem, for meshes of up to a million faces usually
/// at intervals of less than 0.3 seconds (docs/robustness.md, "Cancellation"). An exception that it throws ends
/// the run and is passed on to the caller of faqem. During one call neither the phase nor its fraction goes back.
/// \param phase     current phase
/// \param fraction  completed share of the phase, in [0, 1]; several calls may have the same value
/// \return Continue::cancel to end the run with StopReason::cancelled
using Progress = std::function<Continue(Phase phase, double fraction)>;

FAQEM_NAMESPACE_END
