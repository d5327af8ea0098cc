// Keeps the error messages of libpng off the standard error of the process.
//
// OpenImageIO sets an error handler that stores the message for geterror() and returns. libpng then calls its
// own handler, which prints "libpng error: ..." and jumps back to OpenImageIO. Up to version 3.1, OpenImageIO
// has no option for this. Redirecting standard error would lose what other threads write to it meanwhile, and
// checking a PNG completely before it is decoded would mean decompressing it twice.
//
// So the plugin defines png_set_error_fn(), which sets a handler that calls the given one and then jumps
// itself. Only libraries that are loaded for the plugin call this function: the dynamic linker searches the plugin
// before libpng for them, and never for the program and its other libraries, since the plugin is opened with
// RTLD_LOCAL. Processes that have loaded OpenImageIO or libpng before keep what libpng does by itself.

#include <dlfcn.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

#include "faqem/export.hpp"

struct png_struct_def;  // as in png.h, which is not needed to build faqem

namespace {

using Handler = void (*)(png_struct_def* png, const char* message);

/// Finds a function of libpng.
template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// OpenImageIO has a handler for reading and one for writing; other image libraries may have more.
constexpr std::size_t max_handlers = 16;
/// The given handlers in the order of their first use. A handler that is set is never changed.
constinit std::array<std::atomic<Handler>, max_handlers> handlers = {};

template <std::size_t i>
void handle_and_jump(png_struct_def* png, const char* message) {
    handlers[i].load()(png, message);
    static const auto jump = next<void(png_struct_def*, int)>("png_longjmp");
    if (jump) jump(png, 1);  // libpng prints nothing only if the handler does not return
}

template <std::size_t... i>
constexpr std::array<Handler, max_handlers> make_jumping_handlers(std::index_sequence<i...>) {
    return {handle_and_jump<i>...};
}

/// Returns a handler that calls the given one and does not return; the given one if there are too many.
Handler jumping(Handler given) {
    static constexpr auto all = make_jumping_handlers(std::make_index_sequence<max_handlers>());
    for (std::size_t i = 0; i < max_handlers; ++i) {
        Handler expected = nullptr;
        if (handlers[i].compare_exchange_strong(expected, given) || expected == given) return all[i];
    }
    return given;
}

}  // namespace

/// Weak, so that a static libpng can be linked into the plugin; its own function is used then.
extern "C" FAQEM_EXPORT __attribute__((weak)) void png_set_error_fn(png_struct_def* png, void* user,
                                                                    Handler error, Handler warning) {
    static const auto set = next<void(png_struct_def*, void*, Handler, Handler)>("png_set_error_fn");
    if (set) set(png, user, error ? jumping(error) : nullptr, warning);
}
