#pragma once
/// \file
/// Estimate of the memory for decoding a glTF file, from its JSON. A small file can need much memory: each
/// use of an accessor by a mesh, and of a file or view by an image, is a copy of its own.

#include <cstdint>
#include <filesystem>

namespace faqem::cli {

/// Returns an upper estimate, in bytes, of the memory for the meshes, decompressed buffers and repeated images
/// of a glTF file, in addition to that for its JSON and for the bytes of its files. Reads the JSON only, twice.
/// Counts and sizes that the files cannot have are left out: load() reports an error for them.
/// Needs 24 bytes per accessor and view, and the names of the attributes of one mesh.
/// \param model    a regular file. Of a file that is damaged or no glTF, the part before the error is counted
/// \param stored_bytes  of all files of the model
/// \param allowed  bytes; the estimate may end when it exceeds them
std::uint64_t estimated_decoding_memory(const std::filesystem::path& model, std::uint64_t stored_bytes,
                                        std::uint64_t allowed);

}  // namespace faqem::cli
