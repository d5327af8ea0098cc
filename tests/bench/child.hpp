#pragma once
/// \file
/// Runs a simplifier in a child process, so that a crash, hang or memory leak affects only its own row.

#include <optional>
#include <string>

#include "simplifier.hpp"

namespace faqem::bench {

/// Limits of one child process.
struct Limits {
    unsigned seconds =
        300;  ///< CPU time of all threads and runs; the elapsed time is limited to ten times as much
    double gibibytes = 12;     ///< address space
    unsigned max_runs = 3;     ///< small meshes are simplified repeatedly, and the fastest run is reported
    double enough_time = 0.5;  ///< no further run is started after this total time, seconds
};

/// Result of a child process.
struct ChildResult {
    std::string status;  ///< `ok`, `timeout`, `crash: ...` or `refused: ...` (the simplifier threw)
    std::optional<Outcome> outcome;  ///< set if the status is `ok`
    double seconds = 0;              ///< elapsed time of the fastest run, from input arrays to output arrays
    double cpu_seconds = 0;          ///< CPU time of all threads of that run
    double peak_mebibytes = 0;       ///< peak resident memory, above that at the start of the child
};

/// Simplifies a mesh in a child process. \pre no other thread is running (the process is forked)
/// \throws std::runtime_error  the process cannot be started or its result cannot be read
ChildResult run_in_child(const Simplify& simplify, const TriangleMesh& mesh, std::size_t target_faces,
                         const Limits& limits);

}  // namespace faqem::bench
