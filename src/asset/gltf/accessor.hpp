#pragma once
/// \file
/// Layout of glTF accessors, and reading of their elements.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/gltf/source_document.hpp"

namespace faqem::detail {

/// Component types with their glTF constants.
enum class ComponentType : std::uint32_t {
    i8 = 5120,
    u8 = 5121,
    i16 = 5122,
    u16 = 5123,
    u32 = 5125,
    f32 = 5126
};

/// Size of a component in bytes; 0 if the type is unknown.
std::uint32_t component_size(std::uint64_t type);

/// Number of components of an accessor type such as "VEC3"; 0 if the type is unknown.
std::uint32_t component_count(const std::string& type);

/// Size of an element in bytes. Matrix columns are aligned to 4 bytes.
std::uint32_t element_size(std::uint64_t component_type, const std::string& type);

/// Distance of the values that neighbouring integers of an accessor stand for; 0 for floats and 32-bit integers.
/// \param accessor  its description in the document
double integer_step(const Json& accessor);

/// Reads the elements of an accessor as contiguous bytes, with sparse substitution applied. Elements are zero
/// if the accessor has no buffer view.
/// \pre validate_gltf() and check_sparse() passed
std::vector<std::uint8_t> dense_bytes(const SourceDocument& source, Index accessor);

/// Reads the elements of an accessor as vectors. Normalised integers are converted to [0, 1] or [-1, 1].
/// \tparam T  float or double
/// \tparam N  number of components, 1 to 4; missing components are set to `fill`, excess ones are dropped
/// \pre as for dense_bytes()
template <class T, std::size_t N>
std::vector<std::array<T, N>> read_vectors(const SourceDocument& source, Index accessor, T fill = 0);

/// Reads a SCALAR accessor of unsigned integers. \pre as for dense_bytes()
std::vector<Index> read_indices(const SourceDocument& source, Index accessor);

/// Reads a VEC4 accessor of unsigned bytes or shorts. \pre as for dense_bytes()
std::vector<std::array<std::uint16_t, 4>> read_joints(const SourceDocument& source, Index accessor);

/// Checks that the indices of each sparse accessor are strictly increasing and less than its count. This
/// needs the buffers and is therefore separate from validate_gltf().
/// \param file  path for messages
/// \throws InputError  if they are not
void check_sparse(const SourceDocument& source, const std::string& file);

}  // namespace faqem::detail
