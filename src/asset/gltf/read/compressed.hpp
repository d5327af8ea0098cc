#pragma once
/// \file
/// Compressed data in glTF: EXT_meshopt_compression and KHR_draco_mesh_compression. It is validated with the
/// rest of the document and decompressed when the buffers are loaded. Afterwards the document is the same as
/// that of an uncompressed file.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/source_document.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

/// Error message for compressed data that this build cannot decode. Names the extension and the library.
std::string missing_decoder_message(std::string_view extension);

/// Whether a buffer is a placeholder without data for decompressed views (the fallback buffer of
/// EXT_meshopt_compression).
bool is_fallback_buffer(const Json& buffer);

/// The same for the buffer of a view.
bool has_fallback_buffer(const Json& document, const Json& view);

/// The meshopt extension of a view that must be decompressed; null if the view has uncompressed data.
const Json& meshopt_extension(const Json& document, const Json& view);

/// Checks that the range of a view, or of its compressed data, is in its buffer, which has been checked.
/// \return the buffer
/// \throws InputError  it is not
const Json& checked_buffer(const CheckedJson& view);

/// Validates the EXT_meshopt_compression of a view against the buffers and the view, including the
/// compression ratio.
/// \throws InputError, UnsupportedError  if it is invalid or cannot be decoded
void check_meshopt(const CheckedJson& view);

/// Whether an accessor of the primitive has only the data of KHR_draco_mesh_compression.
bool needs_draco(const Json& document, const Json& primitive);

/// Validates the Draco extension of a primitive.
/// \pre needs_draco()
/// \throws InputError, UnsupportedError  if it is invalid or cannot be decoded
void check_draco(const CheckedJson& primitive);

/// For each accessor, nonzero if a primitive with Draco data uses it, so that it may have no buffer view. The
/// meshes need not be validated.
std::vector<char> draco_accessor_flags(const Json& document);

/// Limit on the number of elements of Draco meshes: a base value plus a value per byte of the buffers. Memory
/// is allocated according to counts in the file, which may be arbitrary.
inline constexpr std::uint64_t draco_base_element_limit = std::uint64_t{1} << 22,
                               max_draco_elements_per_byte = 256;

/// Limits the total decompressed size of a file by the size of the file, not by how often its bytes are referenced.
struct DecompressionLimit {
    std::uint64_t remaining;
    const std::string& file;  ///< path for messages

    /// Subtracts an amount from what remains.
    /// \param where      JSON pointer for messages
    /// \param extension  name for messages
    /// \throws InputError  if less remains
    void consume(std::uint64_t amount, const std::string& where, const char* extension) {
        if (amount > remaining)
            throw InputError(
                file, where,
                std::string(extension) + ": the total decompressed size exceeds the limit for this file");
        remaining -= amount;
    }
};

/// Decompresses all views and primitives that have no uncompressed data into new buffers, and removes the
/// extensions from the document.
/// \param file  path for messages
/// \pre parse_gltf() passed
/// \throws InputError  if the data is damaged or the decompressed size exceeds the limit
void decompress(SourceDocument& source, const std::string& file);

/// Decodes the elements of a view compressed with meshoptimizer.
/// \param extension  validated EXT_meshopt_compression object
/// \param bytes      compressed data, borrowed
/// \param file       path for messages
/// \param where      JSON pointer of the view, for messages
/// \throws InputError  if the data is damaged
std::vector<std::uint8_t> decode_meshopt(const Json& extension, std::span<const std::uint8_t> bytes,
                                         const std::string& file, const std::string& where);

/// An attribute of a Draco mesh, in the format of its accessor.
struct DracoAttribute {
    std::uint32_t id = 0;  ///< unique id in the Draco mesh
    NumberType type = NumberType::f32;
    std::uint32_t components = 0;     ///< components per vertex
    std::vector<std::uint8_t> bytes;  ///< contiguous elements, set by decode_draco()
};

/// Decodes a Draco mesh. The counts in its header are compared with those of the accessors before memory is
/// allocated.
/// \param bytes       compressed data, borrowed
/// \param vertices    count of the attribute accessors
/// \param corners     count of the index accessor
/// \param attributes  attributes to decode; `bytes` is set
/// \param file        path for messages
/// \param where       JSON pointer of the primitive, for messages
/// \return the vertex index of each corner
/// \throws InputError        if the data is damaged or does not match the accessors
/// \throws UnsupportedError  if the bitstream version is below 2.2
std::vector<std::uint32_t> decode_draco(std::span<const std::uint8_t> bytes, std::uint64_t vertices,
                                        std::uint64_t corners, std::vector<DracoAttribute>& attributes,
                                        const std::string& file, const std::string& where);

}  // namespace faqem::detail
