// Compiles include/faqem/detail/options.
#include "faqem/detail/options/option_table-inl.hpp"
