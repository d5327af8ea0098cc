// Calls both build modes in one process, and catches an exception of each.
#include <faqem/error.hpp>

#include <cstdio>

extern "C" unsigned long simplify_square_header_only(double ratio);
extern "C" unsigned long simplify_square_compiled(double ratio);

template <class Function>
bool throws(Function function) {
    try {
        function(2.0);
    } catch (const faqem::OptionError&) {
        return true;
    }
    return false;
}

int main() {
    const unsigned long a = simplify_square_header_only(0.1), b = simplify_square_compiled(0.1);
    std::printf("%lu and %lu faces\n", a, b);
    return a == b && a <= 80 && throws(simplify_square_header_only) && throws(simplify_square_compiled) ? 0
                                                                                                        : 1;
}
