#pragma once
/// \file
/// Layout of glTF accessors, and reading of their elements.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asset/gltf/source_document.hpp"
#include "asset/io/number_type.hpp"

namespace faqem::detail {

/// The type of the components of an accessor, or of another object that has one.
inline NumberType component_type(const Json& accessor) {
    return static_cast<NumberType>(unsigned_member(accessor, "componentType", 0));
}

/// Whether accessors may have components of a type.
constexpr bool is_component_type(std::uint64_t type) {
    return type >= 5120 && type <= 5126 && type != static_cast<std::uint64_t>(NumberType::i32);
}

/// Whether indices may have a type.
constexpr bool is_index_type(NumberType type) {
    return type == NumberType::u8 || type == NumberType::u16 || type == NumberType::u32;
}

/// Number of components of an accessor type such as "VEC3"; 0 if the type is unknown.
std::uint32_t component_count(const std::string& type);

/// Size of an element of an accessor in bytes. Matrix columns are aligned to 4 bytes.
std::size_t element_size(const Json& accessor);

/// Distance of the values that neighbouring integers of an accessor stand for; 0 for floats and 32-bit integers.
/// \param accessor  its description in the document
double integer_step(const Json& accessor);

/// The bytes of a buffer view, or of another object that refers to a buffer in this way. They belong to the source.
std::span<const std::uint8_t> view_bytes(const SourceDocument& source, const Json& view);

/// Reads the elements of an accessor as contiguous bytes, with sparse substitution applied. Elements are zero
/// if the accessor has no buffer view.
/// \pre parse_gltf() and check_sparse() passed
std::vector<std::uint8_t> dense_bytes(const SourceDocument& source, Index accessor);

/// Reads the elements of an accessor as vectors. Normalised integers are converted to [0, 1] or [-1, 1].
/// \tparam T  float, double, or std::uint16_t for the numbers of joints
/// \tparam N  number of components, 1 to 4; missing components are set to `fill`, excess ones are dropped
/// \pre as for dense_bytes()
template <class T, std::size_t N>
std::vector<std::array<T, N>> read_vectors(const SourceDocument& source, Index accessor, T fill = 0);

/// The same, or `count` times `neutral` if the accessor is no_index. Missing components are the last one of `neutral`.
template <class T, std::size_t N>
std::vector<std::array<T, N>> vectors_or(const SourceDocument& source, Index accessor, std::size_t count,
                                         const std::array<T, N>& neutral) {
    if (accessor == no_index) return std::vector<std::array<T, N>>(count, neutral);
    return read_vectors<T, N>(source, accessor, neutral[N - 1]);
}

/// Reads a SCALAR accessor of unsigned integers. \pre as for dense_bytes()
std::vector<Index> read_indices(const SourceDocument& source, Index accessor);

/// Checks that the indices of each sparse accessor are strictly increasing and less than its count. This
/// needs the buffers and is therefore separate from parse_gltf().
/// \param file  path for messages
/// \throws InputError  if they are not
void check_sparse(const SourceDocument& source, const std::string& file);

}  // namespace faqem::detail
