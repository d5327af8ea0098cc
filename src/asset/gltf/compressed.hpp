#pragma once
/// \file
/// Compressed data inside glTF: EXT_meshopt_compression and KHR_draco_mesh_compression. It is checked with
/// the rest of the document and unpacked once the buffers are there; then the document is as if it had been
/// plain.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/check/checker.hpp"
#include "asset/source_document.hpp"

namespace faqem::detail {

inline constexpr const char* meshopt_name = "EXT_meshopt_compression";
inline constexpr const char* draco_name = "KHR_draco_mesh_compression";

/// Whether this library was built with a decoder for the extension.
bool can_decode(std::string_view extension);

/// "EXT_x needs a build with library y", for errors.
std::string missing_decoder_message(std::string_view extension);

/// A buffer that only stands for what compressed views will hold: it has no bytes of its own.
bool is_fallback_buffer(const Json& buffer);

/// The compressed data that a view is made of, null where it is plain.
const Json& meshopt_extension(const Json& document, const Json& view);

/// Checks a view's EXT_meshopt_compression against the buffers and the view, ratio included.
/// \param where  of the view
void check_meshopt(const GltfChecker& checker, const Json& view, const std::string& where);

/// Whether some accessor of the primitive has no bytes but those in KHR_draco_mesh_compression.
bool needs_draco(const Json& document, const Json& primitive);

/// Checks the extension of a primitive with needs_draco(). \param where  of the primitive
void check_draco(const GltfChecker& checker, const Json& primitive, const std::string& where);

/// By accessor: nonzero where Draco data may vouch for its count. Asks nothing of the meshes' validity.
std::vector<char> draco_accessor_flags(const Json& document);

/// So many elements of a Draco mesh are believed of few bytes, and so many of each byte in all: a header may
/// say anything, and memory is taken by what it says.
inline constexpr std::uint64_t draco_base_element_limit = std::uint64_t{1} << 22,
                               max_draco_elements_per_byte = 256;

/// How much may still be unpacked of a file: that grows with the bytes there are, not with how often they are
/// referred to.
class DecompressionBudget {
public:
    /// \param file  for messages; borrowed
    DecompressionBudget(std::uint64_t amount, const std::string& file) : remaining_(amount), file_(file) {}
    /// \throws InputError  less is left
    void consume(std::uint64_t amount, const std::string& where, const char* extension);

private:
    std::uint64_t remaining_;
    const std::string& file_;
};

/// Unpacks every compressed view and primitive that has no plain data into new buffers, and takes the
/// extensions out of the document.
/// \pre the document is valid
/// \throws InputError  damaged data, or more than all buffers can hold
void decompress(SourceDocument& source, const std::string& file);

/// The elements of a meshopt view.
/// \param extension  checked
/// \throws InputError
std::vector<std::uint8_t> decode_meshopt(const Json& extension, std::span<const std::uint8_t> bytes,
                                         const std::string& file, const std::string& where);

/// What an accessor wants of a Draco mesh.
struct DracoAttribute {
    std::uint32_t id = 0;
    ComponentType type = ComponentType::f32;
    std::uint32_t components = 0;
    std::vector<std::uint8_t> bytes;  ///< filled by decode_draco(), back to back
};

/// Decodes a mesh. The counts in its header are held against the accessors' before anything is allocated.
/// \param vertices  of every attribute
/// \param corners   of the index accessor
/// \return the corners
/// \throws InputError
std::vector<std::uint32_t> decode_draco(std::span<const std::uint8_t> bytes, std::uint64_t vertices,
                                        std::uint64_t corners, std::vector<DracoAttribute>& attributes,
                                        const std::string& file, const std::string& where);

}  // namespace faqem::detail
