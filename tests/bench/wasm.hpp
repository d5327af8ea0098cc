#pragma once
/// \file
/// Versions of meshoptimizer that Debian does not package: as WebAssembly, from npm, run by Node.

#include <string>

#include "speed.hpp"

namespace faqem::bench {

/// What a version made, and the time of the call alone, after one that is not counted.
struct WasmResult {
    double seconds = 0;
    double cpu_seconds = 0;
    TriangleMesh mesh;
};

/// Whether `name` is of the kind that run_wasm() takes.
bool is_wasm(const std::string& name);

/// Simplifies in a process of its own.
/// \param name  `wasm-0.18`, `wasm-1.3`, or `wasm-1.3-update`, which moves vertices
/// \throws OptionError  there is no such version, or it failed
WasmResult run_wasm(const FloatMesh& in, std::size_t target_faces, const std::string& name);

}  // namespace faqem::bench
