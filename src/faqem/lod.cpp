// Compiles include/faqem/detail/lod.
#include "faqem/detail/lod/levels-inl.hpp"
