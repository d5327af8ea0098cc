#pragma once
/// \file
/// The vectors of the engine, for the whole implementation.

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::to_array;
using engine::to_eigen;
using engine::Vector3;

}  // namespace detail
FAQEM_NAMESPACE_END
