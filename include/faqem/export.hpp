#pragma once
/// \file
/// Symbol visibility, and the two build modes of the geometry half.
///
/// Without FAQEM_HEADER_ONLY the headers declare, and the library faqem::faqem has the bodies. With it, which the
/// target faqem::header_only defines, each header includes its bodies (`-inl.hpp`). All of a program's code that
/// exchanges faqem's types must use the same mode: names of the header-only mode are in an inline namespace, so
/// that mixing the modes is a link error.

/// FAQEM_EXPORT marks a function or class that other libraries may call: every other symbol of a shared library is
/// hidden. It goes before a function's declaration, and between `class` and its name.
/// FAQEM_EXCEPTION marks exception classes, which must be visible in both modes to be caught across libraries.
/// FAQEM_INLINE goes before each function definition in an `-inl.hpp` file that a header declares.
/// FAQEM_NAMESPACE_BEGIN and FAQEM_NAMESPACE_END enclose the contents of `namespace faqem`.
#define FAQEM_EXCEPTION [[gnu::visibility("default")]]
#ifdef FAQEM_HEADER_ONLY
#ifdef __FAST_MATH__
#error "faqem needs IEEE arithmetic: compile without -ffast-math"
#endif
#define FAQEM_EXPORT
#define FAQEM_INLINE inline
#define FAQEM_NAMESPACE_BEGIN \
    namespace faqem {         \
    inline namespace [[gnu::visibility("hidden")]] header_only_0_1 {
#define FAQEM_NAMESPACE_END \
    }                       \
    }
#else
#define FAQEM_EXPORT [[gnu::visibility("default")]]
#define FAQEM_INLINE
#define FAQEM_NAMESPACE_BEGIN namespace faqem {
#define FAQEM_NAMESPACE_END }
#endif
