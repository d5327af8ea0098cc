#pragma once
/// \file
/// Versions of meshoptimizer that Debian does not package: WebAssembly modules from npm, run with Node.

#include <string>

#include "speed.hpp"

namespace faqem::bench {

/// Result of a run. Times are those of the second call, after a first one for the just-in-time compiler.
struct WasmResult {
    double seconds = 0;      ///< elapsed time of the call
    double cpu_seconds = 0;  ///< CPU time of the call
    TriangleMesh mesh;
};

/// Returns whether a simplifier is one of run_wasm().
bool is_wasm(const std::string& name);

/// Simplifies a mesh in a child process.
/// \param name  `wasm-0.18`, `wasm-1.3`, or `wasm-1.3-update` (which moves vertices)
/// \throws OptionError  there is no such version, or the process failed
WasmResult run_wasm(const FloatMesh& in, std::size_t target_faces, const std::string& name);

}  // namespace faqem::bench
