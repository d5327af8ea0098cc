// Compiles include/faqem/detail/geometry.
#include "faqem/detail/geometry/bvh-inl.hpp"
#include "faqem/detail/geometry/halfedges-inl.hpp"
#include "faqem/detail/geometry/near_triangles-inl.hpp"
#include "faqem/detail/geometry/random_sampling-inl.hpp"
#include "faqem/detail/geometry/surface-inl.hpp"
#include "faqem/detail/geometry/surface_samples-inl.hpp"
