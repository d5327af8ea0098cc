#pragma once
/// \file
/// What code blocks take for granted: the reader's own data.

#include <faqem/faqem.hpp>
#include <iostream>

inline std::vector<std::array<float, 3>> positions;
inline std::vector<std::array<std::uint32_t, 3>> triangles;
inline std::vector<faqem::Index> materials;
inline std::vector<float> weights;
inline faqem::Asset source;
inline faqem::Options options;

/// Whatever the reader does with it.
template <class... Results>
void use(const Results&...) {}
