// A shared library that uses faqem inside. Two of them, one of each build mode, are loaded into one process.
#include <faqem/simplify.hpp>

#include "header_only/models.hpp"

#ifdef FAQEM_HEADER_ONLY
#define SIMPLIFY_SQUARE simplify_square_header_only
#else
#define SIMPLIFY_SQUARE simplify_square_compiled
#endif

extern "C" [[gnu::visibility("default")]] unsigned long SIMPLIFY_SQUARE(double ratio) {
    const faqem::TriangleMesh mesh = models::wavy_grid(20);
    return faqem::simplify({mesh.positions, mesh.triangles}, {.target = faqem::ratio(ratio)})
        .mesh.triangles.size();
}
