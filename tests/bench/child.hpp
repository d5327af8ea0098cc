#pragma once
/// \file
/// Runs a simplifier in a process of its own: a crash, a hang or a memory leak of one costs its row only.

#include <optional>
#include <string>

#include "simplifier.hpp"

namespace faqem::bench {

struct Limits {
    unsigned seconds = 300;    ///< of CPU time, all threads and runs; ten times that on the clock
    double gibibytes = 12;     ///< of address space
    unsigned most_runs = 3;    ///< small meshes are run again, and the fastest run counts
    double enough_time = 0.5;  ///< seconds; no further run after that
};

/// What came back from the child.
struct ChildResult {
    std::string status;              ///< `ok`, `timeout`, `crash: ...` or `refused: ...`
    std::optional<Outcome> outcome;  ///< there if the status is `ok`
    double seconds = 0;              ///< wall clock, arrays to arrays; the fastest run
    double cpu_seconds = 0;          ///< of all threads of that run
    double peak_mebibytes = 0;       ///< resident, above what the process had before
};

/// Must be called while no other thread is running.
ChildResult run_in_child(const Simplify& simplify, const TriangleMesh& mesh, std::size_t target_faces,
                         const Limits& limits);

}  // namespace faqem::bench
