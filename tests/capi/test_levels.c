#include "faqem/faqem_levels.h"

#include <math.h>
#include <string.h>

#include "check.h"

static faqem_options* with_history(void) {
    faqem_options* options = faqem_options_create();
    CHECK(faqem_options_set_history(options, FAQEM_RECORDING_ON) == FAQEM_OK);
    return options;
}

/* Returns a curved grid, whose simplification has a non-zero error. */
static faqem_mesh hill(void) {
    static double at[3 * 21 * 21];
    faqem_mesh mesh = flat_grid_of_doubles(20);
    memcpy(at, mesh.double_positions, sizeof at);
    for (size_t v = 0; v < mesh.vertex_count; ++v)
        at[3 * v + 2] = 4 * sin(at[3 * v] / 4) * cos(at[3 * v + 1] / 5);
    mesh.double_positions = at;
    return mesh;
}

static int same_mesh(const faqem_result* a, const faqem_result* b) {
    const size_t v = faqem_result_vertex_count(a), f = faqem_result_face_count(a);
    return v == faqem_result_vertex_count(b) && f == faqem_result_face_count(b) &&
           memcmp(faqem_result_positions(a), faqem_result_positions(b), 3 * v * sizeof(double)) == 0 &&
           memcmp(faqem_result_triangles(a), faqem_result_triangles(b), 3 * f * sizeof(uint32_t)) == 0;
}

static void levels_have_fewer_faces_and_larger_errors(void) {
    const faqem_mesh mesh = hill();
    const faqem_level levels[3] = {
        {FAQEM_LEVEL_RATIO, 0.5}, {FAQEM_LEVEL_FACES, 100}, {FAQEM_LEVEL_DISTANCE_OF_DIAGONAL, 0.1}};
    faqem_result* results[3] = {NULL, NULL, NULL};
    faqem_error error;
    CHECK(faqem_simplify_levels(&mesh, NULL, levels, 3, results, &error) == FAQEM_OK);
    CHECK(faqem_result_face_count(results[0]) <= 400 && faqem_result_face_count(results[0]) > 390);
    CHECK(faqem_result_face_count(results[1]) <= 100 && faqem_result_face_count(results[1]) > 90);
    CHECK(faqem_result_face_count(results[2]) < 90);
    CHECK(faqem_result_level_error(results[0]) > 0);
    CHECK(faqem_result_level_error(results[0]) <= faqem_result_level_error(results[1]));
    CHECK(faqem_result_level_error(results[1]) <= faqem_result_level_error(results[2]));
    for (int i = 0; i < 3; ++i) faqem_result_destroy(results[i]);

    faqem_result* one = NULL;
    CHECK(faqem_simplify(&mesh, NULL, &one, NULL) == FAQEM_OK);
    CHECK(isnan(faqem_result_level_error(one)) && isnan(faqem_result_level_error(NULL)));
    faqem_result_destroy(one);
}

static void invalid_levels_are_rejected_and_no_results_created(void) {
    const faqem_mesh mesh = hill();
    faqem_result* results[2] = {NULL, NULL};
    faqem_error error;
    const faqem_level wrong[][2] = {{{FAQEM_LEVEL_RATIO, 0.1}, {FAQEM_LEVEL_RATIO, 0.5}},
                                    {{FAQEM_LEVEL_RATIO, NAN}, {FAQEM_LEVEL_FACES, 10}},
                                    {{FAQEM_LEVEL_FACES, 10.5}, {FAQEM_LEVEL_FACES, 10}},
                                    {{FAQEM_LEVEL_FACES, -1}, {FAQEM_LEVEL_FACES, 10}},
                                    {{FAQEM_LEVEL_DISTANCE, INFINITY}, {FAQEM_LEVEL_FACES, 10}},
                                    {{(faqem_level_kind)4, 1}, {FAQEM_LEVEL_FACES, 10}}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK(faqem_simplify_levels(&mesh, NULL, wrong[i], 2, results, &error) == FAQEM_ERROR_OPTION);
        CHECK(error.message[0] != '\0' && results[0] == NULL && results[1] == NULL);
    }
    CHECK(faqem_simplify_levels(&mesh, NULL, NULL, 2, results, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_simplify_levels(&mesh, NULL, wrong[0], 1, NULL, &error) == FAQEM_ERROR_OPTION);
}

static void a_history_reproduces_every_level(void) {
    const faqem_mesh mesh = hill();
    const faqem_level levels[2] = {{FAQEM_LEVEL_FACES, 300}, {FAQEM_LEVEL_FACES, 50}};
    faqem_options* options = with_history();
    faqem_result* results[2] = {NULL, NULL};
    CHECK(faqem_simplify_levels(&mesh, options, levels, 2, results, NULL) == FAQEM_OK);
    faqem_history *made = NULL, *history = NULL;
    CHECK(faqem_history_create((const faqem_result* const*)results, 2, &made, NULL) == FAQEM_OK);
    size_t size = 0;
    const uint8_t* bytes = faqem_history_bytes(made, &size);
    CHECK(size > 8 && memcmp(bytes, "FAQEM", 5) == 0);
    faqem_error error;
    CHECK(faqem_history_read(bytes, size, &history, &error) == FAQEM_OK);
    CHECK(faqem_history_level_count(history) == 2);
    for (int i = 0; i < 2; ++i) {
        faqem_result* cut = NULL;
        CHECK(faqem_history_truncate(history, (uint64_t)levels[i].value, &cut, NULL) == FAQEM_OK);
        CHECK(same_mesh(cut, results[i]));
        CHECK(memcmp(faqem_result_face_origin(cut), faqem_result_face_origin(results[i]),
                     faqem_result_face_count(cut) * sizeof(uint32_t)) == 0);
        CHECK(faqem_result_vertex_origin(cut) == NULL);
        faqem_result_destroy(cut);
    }
    faqem_result* between = NULL;
    CHECK(faqem_history_truncate(history, 150, &between, NULL) == FAQEM_OK);
    CHECK(faqem_result_face_count(between) <= 150 && faqem_result_face_count(between) > 140);
    faqem_result_destroy(between);

    faqem_history* broken = NULL;
    CHECK(faqem_history_read(bytes, size - 1, &broken, &error) == FAQEM_ERROR_INPUT && broken == NULL);
    CHECK(faqem_history_read(bytes, 0, &broken, &error) == FAQEM_ERROR_INPUT);
    CHECK(faqem_history_truncate(history, 0, &between, &error) == FAQEM_ERROR_OPTION);
    faqem_history_destroy(made);
    faqem_history_destroy(history);
    faqem_history_destroy(NULL);
    for (int i = 0; i < 2; ++i) faqem_result_destroy(results[i]);
    faqem_options_destroy(options);
}

static void points_of_a_flat_grid_are_mapped_to_themselves(void) {
    const faqem_mesh mesh = flat_grid_of_doubles(20);
    faqem_options* options = with_history();
    faqem_result* result = NULL;
    CHECK(faqem_simplify(&mesh, options, &result, NULL) == FAQEM_OK);
    const uint32_t count = (uint32_t)faqem_result_face_count(result);
    for (uint32_t f = 0; f < count; ++f) {
        const double weights[3] = {0.5, 0.25, 0.25};
        uint32_t face = 0;
        double there[3];
        CHECK(faqem_result_map(result, &f, weights, 1, &face, there, NULL) == FAQEM_OK);
        CHECK(face < mesh.face_count);
        for (int k = 0; k < 2; ++k) {
            double here = 0, mapped = 0;
            for (int c = 0; c < 3; ++c) {
                here += weights[c] *
                        faqem_result_positions(result)[3 * faqem_result_triangles(result)[3 * f + c] + k];
                mapped += there[c] * mesh.double_positions[3 * mesh.triangles[3 * face + c] + k];
            }
            CHECK(fabs(here - mapped) < 1e-6);
        }
    }
    uint32_t face = count;
    double weights[3] = {1, 0, 0}, there[3];
    faqem_error error;
    CHECK(faqem_result_map(result, &face, weights, 1, &face, there, &error) == FAQEM_ERROR_INPUT);
    face = 0;
    weights[0] = NAN;
    CHECK(faqem_result_map(result, &face, weights, 1, &face, there, &error) == FAQEM_ERROR_INPUT);
    weights[0] = 1;
    faqem_result_destroy(result);

    CHECK(faqem_simplify(&mesh, NULL, &result, NULL) == FAQEM_OK); /* without a history */
    CHECK(faqem_result_map(result, &face, weights, 1, &face, there, &error) == FAQEM_ERROR_OPTION);
    faqem_history* history = NULL;
    CHECK(faqem_history_create((const faqem_result* const*)&result, 1, &history, &error) ==
          FAQEM_ERROR_OPTION);
    faqem_result_destroy(result);
    faqem_options_destroy(options);
}

static void corner_values_are_interpolated(void) {
    faqem_mesh mesh = flat_grid_of_doubles(20);
    static float uv[2 * 3 * 800];
    for (size_t c = 0; c < 3 * mesh.face_count; ++c)
        for (int k = 0; k < 2; ++k)
            uv[2 * c + k] = (float)(mesh.double_positions[3 * mesh.triangles[c] + k] / 20);
    mesh.corner_values = uv;
    mesh.corner_width = 2;
    faqem_result* result = NULL;
    CHECK(faqem_simplify(&mesh, NULL, &result, NULL) == FAQEM_OK);
    CHECK(faqem_result_corner_width(result) == 2);
    const size_t corners = 3 * faqem_result_face_count(result);
    CHECK(corners > 0 && corners < 3 * 100);
    for (size_t c = 0; c < corners; ++c) {
        for (int k = 0; k < 2; ++k) {
            const double at = faqem_result_positions(result)[3 * faqem_result_triangles(result)[c] + k] / 20;
            CHECK(fabs(faqem_result_corner_values(result)[2 * c + k] - at) < 1e-5);
        }
    }
    faqem_result_destroy(result);
    faqem_error error;
    mesh.corner_width = 0;
    CHECK(faqem_simplify(&mesh, NULL, &result, &error) == FAQEM_ERROR_INPUT);
    mesh.corner_values = NULL;
    mesh.corner_width = 2;
    CHECK(faqem_simplify(&mesh, NULL, &result, &error) == FAQEM_ERROR_INPUT);
}

void test_levels(void) {
    levels_have_fewer_faces_and_larger_errors();
    invalid_levels_are_rejected_and_no_results_created();
    a_history_reproduces_every_level();
    points_of_a_flat_grid_are_mapped_to_themselves();
    corner_values_are_interpolated();
}
