// Compiles include/faqem/detail/measure.
#include "faqem/detail/measure/compare-inl.hpp"
#include "faqem/detail/measure/hausdorff-inl.hpp"
#include "faqem/detail/measure/mesh_info-inl.hpp"
#include "faqem/detail/measure/removed_components-inl.hpp"
