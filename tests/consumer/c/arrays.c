/* Simplifies a mesh in flat arrays from C. */
#include <faqem/faqem.h>
#include <stdio.h>

enum { side = 20 };

int main(void) {
    static float positions[3 * (side + 1) * (side + 1)]; /* a flat grid of 20 x 20 squares */
    static uint32_t triangles[6 * side * side];
    float* p = positions;
    uint32_t* t = triangles;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) *p++ = (float)i, *p++ = (float)j, *p++ = 0;
    }
    for (uint32_t i = 0; i < side; ++i) {
        for (uint32_t j = 0; j < side; ++j) {
            const uint32_t a = i * (side + 1) + j, b = a + side + 1;
            *t++ = a, *t++ = b, *t++ = b + 1, *t++ = a, *t++ = b + 1, *t++ = a + 1;
        }
    }
    const faqem_mesh mesh = {.positions = positions,
                             .vertex_count = (side + 1) * (side + 1),
                             .triangles = triangles,
                             .face_count = 2 * side * side};
    faqem_result* result = NULL;
    faqem_error error;
    if (faqem_simplify(&mesh, NULL, &result, &error) != FAQEM_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    const size_t faces = faqem_result_face_count(result);
    faqem_result_destroy(result);
    return faces > 0 && faces <= 80 ? 0 : 1;
}
