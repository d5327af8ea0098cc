#pragma once
/// \file
/// How the setters of the C door's options are written.

#include <type_traits>

#include "capi/report.hpp"

namespace faqem::capi {

/// Changes the options where there are any.
template <class Change>
faqem_status set(faqem_options* options, Change&& change) {
    if (!options) return FAQEM_ERROR_OPTION;
    change(options->options);
    return FAQEM_OK;
}

/// Sets a member to an enumerator of the same number. \param last  the last that there is; the first is 0
template <class Value, class Member>
faqem_status set_enum(faqem_options* options, Value value, Value last, Member&& member) {
    if (!options || value < 0 || value > last) return FAQEM_ERROR_OPTION;
    auto& field = member(options->options);
    field = static_cast<std::remove_reference_t<decltype(field)>>(value);
    return FAQEM_OK;
}

/// Whether enumerators of both doors have one number.
template <class CEnum, class CppEnum>
constexpr bool has_same_value(CEnum there, CppEnum here) {
    return static_cast<int>(there) == static_cast<int>(here);
}

}  // namespace faqem::capi
