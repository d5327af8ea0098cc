#include "capi/guard.hpp"

#include <cstring>
#include <exception>
#include <new>
#include <string_view>

namespace faqem::capi {

namespace {

constexpr std::string_view ellipsis = " ...";

bool is_utf8_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

void write_message(faqem_error& error, std::string_view text) {
    constexpr std::size_t capacity = sizeof error.message - 1;
    std::size_t length = text.size();
    if (length > capacity) {
        length = capacity - ellipsis.size();
        while (length > 0 && is_utf8_continuation(text[length])) --length;
    }
    std::memcpy(error.message, text.data(), length);
    if (length < text.size()) {
        std::memcpy(error.message + length, ellipsis.data(), ellipsis.size());
        length += ellipsis.size();
    }
    error.message[length] = '\0';
}

faqem_status set_error(faqem_error* error, faqem_status status, std::string_view text) {
    if (error) {
        error->status = status;
        write_message(*error, text);
    }
    return status;
}

faqem_status status_of(const std::exception& error) {
    if (dynamic_cast<const CancelledError*>(&error)) return FAQEM_ERROR_CANCELLED;
    if (dynamic_cast<const OptionError*>(&error)) return FAQEM_ERROR_OPTION;
    if (dynamic_cast<const UnsupportedError*>(&error)) return FAQEM_ERROR_UNSUPPORTED;
    if (dynamic_cast<const InputError*>(&error)) return FAQEM_ERROR_INPUT;
    if (dynamic_cast<const WriteError*>(&error)) return FAQEM_ERROR_WRITE;
    if (dynamic_cast<const ByteLimitError*>(&error)) return FAQEM_ERROR_BYTE_LIMIT;
    if (dynamic_cast<const TimeLimitError*>(&error)) return FAQEM_ERROR_TIME_LIMIT;
    return FAQEM_ERROR_INTERNAL;
}

}  // namespace

faqem_status status_of_exception(faqem_error* error) noexcept {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        return set_error(error, FAQEM_ERROR_NO_MEMORY, "not enough memory");
    } catch (const std::exception& e) {
        return set_error(error, status_of(e), e.what());
    } catch (...) {
        return set_error(error, FAQEM_ERROR_INTERNAL, "unknown exception");
    }
}

}  // namespace faqem::capi
