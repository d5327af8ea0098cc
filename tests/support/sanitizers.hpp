#pragma once
// Defines FAQEM_SANITIZED if the tests run under a sanitizer that needs additional memory or address space.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FAQEM_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FAQEM_SANITIZED
#endif
#endif
