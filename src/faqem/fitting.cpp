// Compiles include/faqem/detail/fitting.
#include "faqem/detail/fitting/closest_point_tracker-inl.hpp"
#include "faqem/detail/fitting/edge_flip_search-inl.hpp"
#include "faqem/detail/fitting/gauss_newton-inl.hpp"
#include "faqem/detail/fitting/vertex_fitting-inl.hpp"
