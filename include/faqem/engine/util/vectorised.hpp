#pragma once
/// \file
/// Loops for the widest vector registers of the processor.

#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

#if defined(__GNUC__) && defined(__x86_64__)
/// Calls work(), with all that it calls inlined and compiled for AVX2. \pre the processor has it
template <class Work>
[[gnu::target("avx2"), gnu::flatten, gnu::noinline]] void with_avx2(const Work& work) {
    work();
}
#endif

/// Calls work(), with AVX2 where the processor has it. Results are the same: operations are neither fused nor
/// reordered.
template <class Work>
void vectorised(const Work& work) {
#if defined(__GNUC__) && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return with_avx2(work);
#endif
    work();
}

FAQEM_ENGINE_END
