// Compiles include/faqem/detail/history.
#include "faqem/detail/history/history-inl.hpp"
#include "faqem/detail/history/truncate-inl.hpp"
