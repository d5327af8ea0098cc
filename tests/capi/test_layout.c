#include <string.h>

#include "check.h"

enum { most_elements = 4, longest_step = 27, buffer_size = (most_elements + 2) * longest_step + 8 };

/* Marks the bytes of all numbers; the layout is valid if none is marked twice. */
static int numbers_overlap(size_t count, size_t stride, size_t step, size_t number_size) {
    char taken[buffer_size];
    memset(taken, 0, sizeof taken);
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < 3; ++k)
            for (size_t byte = 0; byte < number_size; ++byte)
                if (taken[i * stride + k * step + byte]++) return 1;
    return 0;
}

/* A mesh of one vertex at the origin and no faces. */
static faqem_mesh one_vertex(void) {
    static const float origin[3];
    faqem_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.positions = origin;
    mesh.vertex_count = 1;
    return mesh;
}

static faqem_status status_of(const faqem_mesh* mesh, const char* array) {
    faqem_result* result = NULL;
    faqem_error error;
    const faqem_status status = faqem_simplify(mesh, NULL, &result, &error);
    CHECK((status == FAQEM_OK) == (result != NULL));
    if (status != FAQEM_OK)
        CHECK(strstr(error.message, array) != NULL && strstr(error.message, "stride") != NULL);
    faqem_result_destroy(result);
    return status;
}

static void exactly_the_layouts_without_overlap_are_accepted(void) {
    static const union {
        float floats[buffer_size];
        double doubles[buffer_size];
        uint32_t indices[buffer_size];
        uint16_t short_indices[buffer_size];
    } zeros;
    for (size_t count = 1; count <= most_elements; ++count) {
        for (size_t stride = 1; stride <= longest_step; ++stride) {
            for (size_t step = 1; step <= longest_step; ++step) {
                faqem_mesh points = one_vertex(), faces = one_vertex();
                points.vertex_count = count;
                points.position_stride = stride;
                points.position_step = step;
                points.positions = zeros.floats;
                CHECK((status_of(&points, "positions") == FAQEM_OK) ==
                      !numbers_overlap(count, stride, step, 4));
                points.positions = NULL;
                points.double_positions = zeros.doubles;
                CHECK((status_of(&points, "positions") == FAQEM_OK) ==
                      !numbers_overlap(count, stride, step, 8));
                faces.face_count = count;
                faces.triangle_stride = stride;
                faces.triangle_step = step;
                faces.triangles = zeros.indices;
                CHECK((status_of(&faces, "triangles") == FAQEM_OK) ==
                      !numbers_overlap(count, stride, step, 4));
                faces.triangles = NULL;
                faces.short_triangles = zeros.short_indices;
                CHECK((status_of(&faces, "triangles") == FAQEM_OK) ==
                      !numbers_overlap(count, stride, step, 2));
            }
        }
    }
}

static void strides_in_numbers_instead_of_bytes_are_rejected(void) {
    for (size_t stride = 1; stride < 3 * sizeof(float); ++stride) {
        faqem_mesh mesh = flat_grid(2);
        mesh.position_stride = stride;
        CHECK(status_of(&mesh, "positions") == FAQEM_ERROR_INPUT);
        mesh = flat_grid(2);
        mesh.triangle_stride = stride;
        CHECK(status_of(&mesh, "triangles") == FAQEM_ERROR_INPUT);
    }
}

/* Nothing is read, so that the address does not matter. */
static void layouts_larger_than_the_address_space_are_rejected(void) {
    static const size_t wrong[][2] = {
        {SIZE_MAX, 4}, {SIZE_MAX - 11, 4}, {12, SIZE_MAX}, {12, SIZE_MAX / 2}, {SIZE_MAX / 8, 4}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        faqem_mesh mesh = flat_grid(2);
        mesh.position_stride = wrong[i][0];
        mesh.position_step = wrong[i][1];
        CHECK(status_of(&mesh, "positions") == FAQEM_ERROR_INPUT);
    }
}

static void the_layout_of_an_empty_array_does_not_matter(void) {
    faqem_mesh mesh = one_vertex();
    mesh.triangle_stride = mesh.triangle_step = 1;
    CHECK(status_of(&mesh, "triangles") == FAQEM_OK);
}

void test_layout(void) {
    exactly_the_layouts_without_overlap_are_accepted();
    strides_in_numbers_instead_of_bytes_are_rejected();
    layouts_larger_than_the_address_space_are_rejected();
    the_layout_of_an_empty_array_does_not_matter();
}
