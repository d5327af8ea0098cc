// Compiles the preparation of a mesh in include/faqem/detail/simplify.
#include "faqem/detail/simplify/preprocess-inl.hpp"
#include "faqem/detail/simplify/prune_components-inl.hpp"
#include "faqem/detail/simplify/spatial_order-inl.hpp"
