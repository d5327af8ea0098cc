#pragma once
/// \file
/// Versions of meshoptimizer that Debian does not package: WebAssembly modules from npm, run with Node.

#include <string>

#include "speed.hpp"

namespace faqem::bench {

/// Returns whether a simplifier is one of run_wasm().
bool is_wasm(const std::string& name);

/// Simplifies a mesh in a child process. Times are those of the second call, after a first one for the just-in-time
/// compiler.
/// \param name  `wasm-0.18`, `wasm-1.3`, or `wasm-1.3-update` (which moves vertices)
/// \throws OptionError  there is no such version, or the process failed
Run run_wasm(const FloatMesh& in, std::size_t target_faces, const std::string& name);

}  // namespace faqem::bench
