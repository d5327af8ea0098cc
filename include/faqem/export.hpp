#pragma once
/// \file
/// Symbol visibility, and the two build modes of the geometry half.
///
/// Without FAQEM_HEADER_ONLY the headers contain declarations, and the library faqem::faqem the definitions.
/// With FAQEM_HEADER_ONLY, which the target faqem::header_only defines, each header includes its definitions
/// (`-inl.hpp`). Code that exchanges faqem's types within one program must use the same mode: in header-only
/// mode all names but those of the exceptions are in an inline namespace, so mixing the modes is a link
/// error. The namespace is named after the major and minor version of version.hpp.

/// FAQEM_EXPORT marks functions and classes that other libraries may use; every other symbol of a shared
/// library is hidden. It precedes the declaration of a function, and stands between `class` and its name.
/// FAQEM_EXCEPTION marks exception classes, which must be visible in both modes to be caught across
/// libraries. FAQEM_INLINE precedes each definition, in an `-inl.hpp` file, of a function that a header
/// declares. FAQEM_NAMESPACE_BEGIN and FAQEM_NAMESPACE_END enclose the contents of `namespace faqem`, and those with
/// DETAIL and ENGINE the contents of `faqem::detail` and `faqem::engine`.
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
#define FAQEM_DETAIL_BEGIN \
    FAQEM_NAMESPACE_BEGIN  \
    namespace detail {
#define FAQEM_DETAIL_END \
    }                    \
    FAQEM_NAMESPACE_END
#define FAQEM_ENGINE_BEGIN \
    FAQEM_NAMESPACE_BEGIN  \
    namespace engine {
#define FAQEM_ENGINE_END \
    }                    \
    FAQEM_NAMESPACE_END
