#pragma once
/// \file
/// Accessors: their layout, and their elements as numbers.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/source_document.hpp"

namespace faqem::detail {

/// glTF's numbers for component types.
enum class ComponentType : std::uint32_t {
    i8 = 5120,
    u8 = 5121,
    i16 = 5122,
    u16 = 5123,
    u32 = 5125,
    f32 = 5126
};

/// Bytes of a component; 0 if there is no such type.
std::uint32_t component_size(std::uint64_t type);

/// Components of an accessor type ("VEC3"); 0 if there is no such type.
std::uint32_t component_count(const std::string& type);

/// Bytes of an element. Columns of matrices start at multiples of 4.
std::uint32_t element_size(std::uint64_t component_type, const std::string& type);

/// The elements of an accessor back to back, sparse replacements applied, all zero without a view.
/// \pre validate_gltf() and check_sparse() passed
std::vector<std::uint8_t> dense_bytes(const SourceDocument& source, Index accessor);

/// Elements with N components as numbers; normalised integers become [0, 1] or [-1, 1].
/// \tparam T  float or double \tparam N  1 to 4; missing components are `fill`, excess ones are left out
template <class T, std::size_t N>
std::vector<std::array<T, N>> read_vectors(const SourceDocument& source, Index accessor, T fill = 0);

/// A SCALAR accessor of unsigned integers.
std::vector<Index> read_indices(const SourceDocument& source, Index accessor);

/// A VEC4 accessor of unsigned bytes or shorts.
std::vector<std::array<std::uint16_t, 4>> read_joints(const SourceDocument& source, Index accessor);

/// Checks the indices of every sparse accessor: increasing and less than its count. Needs the buffers, so it
/// is apart from validate_gltf().
/// \throws InputError
void check_sparse(const SourceDocument& source, const std::string& file);

}  // namespace faqem::detail
