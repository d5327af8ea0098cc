// Compiles include/faqem/detail/base.
#include "faqem/detail/base/closest_word-inl.hpp"
#include "faqem/detail/base/version-inl.hpp"
