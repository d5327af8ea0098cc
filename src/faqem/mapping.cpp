// Compiles include/faqem/detail/mapping.
#include "faqem/detail/mapping/forward_map-inl.hpp"
#include "faqem/detail/mapping/local_map-inl.hpp"
#include "faqem/detail/mapping/replay-inl.hpp"
#include "faqem/detail/mapping/successive_projection-inl.hpp"
#include "faqem/detail/mapping/surface_map-inl.hpp"
#include "faqem/detail/mapping/surface_patches-inl.hpp"
