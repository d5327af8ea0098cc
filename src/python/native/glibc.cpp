// References to glibc that the wheel replaces (-Wl,--wrap=NAME makes `NAME` mean `__wrap_NAME`).
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

// NOLINTBEGIN(bugprone-reserved-identifier): the linker defines these names
extern "C" {

// std::random_device of the static libstdc++ uses this function of glibc 2.36. It has no way to report a failure.
unsigned __wrap_arc4random() {
    unsigned value = 0;
    if (getentropy(&value, sizeof value) != 0) std::abort();
    return value;
}

// Debian's archives of libpng and libjpeg are compiled for programs. In a shared library they can use variables of this
// library only, so they get a copy of this pointer.
extern std::FILE* __real_stderr;
std::FILE* __wrap_stderr = nullptr;
// Before all constructors of static objects, for example std::cerr's.
__attribute__((constructor(101))) void faqem_copy_stderr() { __wrap_stderr = __real_stderr; }

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier)
