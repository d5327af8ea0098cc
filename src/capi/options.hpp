#pragma once
/// \file
/// Helpers for the setters of the C API's options.

#include <type_traits>

#include "capi/report.hpp"

namespace faqem::capi {

/// Applies a change to the options.
/// \return FAQEM_ERROR_OPTION if `options` is null
template <class Change>
faqem_status set(faqem_options* options, Change&& change) {
    if (!options) return FAQEM_ERROR_OPTION;
    change(options->options);
    return FAQEM_OK;
}

/// Sets a member to the C++ enumerator with the same value.
/// \param last    last enumerator of the C enumeration; the first is 0
/// \param member  returns a reference to the member
/// \return FAQEM_ERROR_OPTION if `options` is null or `value` is not an enumerator
template <class Value, class Member>
faqem_status set_enum(faqem_options* options, Value value, Value last, Member&& member) {
    if (!options || value < 0 || value > last) return FAQEM_ERROR_OPTION;
    auto& field = member(options->options);
    field = static_cast<std::remove_reference_t<decltype(field)>>(value);
    return FAQEM_OK;
}

/// Tests whether a C enumerator and a C++ enumerator have the same value.
template <class CEnum, class CppEnum>
constexpr bool has_same_value(CEnum c_value, CppEnum cpp_value) {
    return static_cast<int>(c_value) == static_cast<int>(cpp_value);
}

}  // namespace faqem::capi
