#pragma once

#include <string>

#include "faqem/version.hpp"

FAQEM_NAMESPACE_BEGIN

FAQEM_INLINE std::string_view version() {
    static const std::string text = std::to_string(version_major) + "." + std::to_string(version_minor) +
                                    "." + std::to_string(version_patch);
    return text;
}

FAQEM_NAMESPACE_END
