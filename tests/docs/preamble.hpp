#pragma once
/// \file
/// Declarations of the reader's data and functions that code blocks use.

#include <faqem/faqem.hpp>
#include <iostream>

inline std::vector<std::array<float, 3>> positions;
inline std::vector<std::array<std::uint32_t, 3>> triangles;
inline std::vector<faqem::Index> materials;
inline std::vector<float> weights;
inline faqem::Asset source;
inline faqem::Options options;

/// Stands for code of the reader that uses results.
template <class... Results>
void use(const Results&...) {}
