// Compiles include/faqem/detail/base.
#include "faqem/detail/base/version-inl.hpp"
