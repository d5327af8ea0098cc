#include <math.h>
#include <string.h>

#include "check.h"

static double area(const faqem_result* result) {
    const double* p = faqem_result_positions(result);
    const uint32_t* t = faqem_result_triangles(result);
    double sum = 0;
    for (size_t f = 0; f < faqem_result_face_count(result); ++f, t += 3) {
        const double *a = p + 3 * t[0], *b = p + 3 * t[1], *c = p + 3 * t[2];
        sum += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    return sum;
}

/* A flat square is simplified without changing area and plane. */
static void a_flat_square_is_preserved(faqem_mesh mesh) {
    faqem_options* options = faqem_options_create();
    CHECK(faqem_options_set_ratio(options, 0.1) == FAQEM_OK);
    faqem_result* result = NULL;
    faqem_error error;
    CHECK(faqem_simplify(&mesh, options, &result, &error) == FAQEM_OK);
    CHECK(error.status == FAQEM_OK && error.message[0] == '\0');
    const size_t faces = faqem_result_face_count(result), vertices = faqem_result_vertex_count(result);
    CHECK(faces > 0 && faces <= 80);
    CHECK(fabs(area(result) - 400) < 1e-9);
    for (size_t v = 0; v < vertices; ++v) {
        CHECK(faqem_result_positions(result)[3 * v + 2] == 0);
        CHECK(faqem_result_vertex_origin(result)[v] < mesh.vertex_count);
    }
    for (size_t f = 0; f < faces; ++f) CHECK(faqem_result_face_origin(result)[f] < mesh.face_count);
    for (size_t c = 0; c < 3 * faces; ++c) CHECK(faqem_result_triangles(result)[c] < vertices);
    CHECK(faqem_result_face_groups(result) == NULL);

    faqem_report report;
    CHECK(faqem_result_report(result, &report) == FAQEM_OK);
    CHECK(report.faces_in == 800 && report.faces_out == faces && report.vertices_out == vertices);
    CHECK(report.vertices_in == 441 && report.target_faces == 80);
    CHECK(report.stop == FAQEM_STOP_REACHED_TARGET && report.within_max_error == 1);
    CHECK(isnan(report.error_value) && isnan(report.error_bound));
    CHECK(strstr(faqem_result_report_json(result), "\"stop_reason\": \"reached_target\"") != NULL);
    faqem_result_destroy(result);
    faqem_options_destroy(options);
}

/* Positions and triangles as members of larger structures, and as separate columns. */
static void arrays_may_have_any_stride_and_step(void) {
    enum { vertices = 441, faces = 800 };
    static struct { float normal[3], at[3], weight; } vertex[vertices];
    static struct { uint32_t corners[3], material; } face[faces];
    static double columns[3 * vertices];
    static uint32_t corner_columns[3 * faces];
    const faqem_mesh packed = flat_grid(20);
    CHECK(packed.vertex_count == vertices && packed.face_count == faces);
    for (size_t v = 0; v < vertices; ++v) {
        vertex[v].normal[0] = vertex[v].weight = NAN;
        for (size_t k = 0; k < 3; ++k)
            columns[k * vertices + v] = vertex[v].at[k] = packed.positions[3 * v + k];
    }
    for (size_t f = 0; f < faces; ++f) {
        face[f].material = UINT32_MAX;
        for (size_t k = 0; k < 3; ++k)
            corner_columns[k * faces + f] = face[f].corners[k] = packed.triangles[3 * f + k];
    }
    faqem_mesh mesh = packed;
    mesh.positions = vertex[0].at;
    mesh.position_stride = sizeof vertex[0];
    mesh.triangles = face[0].corners;
    mesh.triangle_stride = sizeof face[0];
    a_flat_square_is_preserved(mesh);
    mesh.positions = NULL;
    mesh.double_positions = columns;
    mesh.position_stride = sizeof columns[0];
    mesh.position_step = vertices * sizeof columns[0];
    mesh.triangles = corner_columns;
    mesh.triangle_stride = sizeof corner_columns[0];
    mesh.triangle_step = faces * sizeof corner_columns[0];
    a_flat_square_is_preserved(mesh);
}

/* Checks that a mesh is rejected with a message that contains a text. */
static void check_rejected(const faqem_mesh* mesh, const char* text) {
    faqem_result* result = NULL;
    faqem_error error;
    CHECK(faqem_simplify(mesh, NULL, &result, &error) == FAQEM_ERROR_INPUT);
    CHECK(result == NULL && error.status == FAQEM_ERROR_INPUT && strstr(error.message, text) != NULL);
}

/* Packed, as members of larger structures and as separate columns. Results are the same as with 32 bits. */
static void indices_may_have_16_bits(void) {
    enum { faces = 800 };
    static uint16_t corners[3 * faces], columns[3 * faces];
    static struct {
        uint8_t flags[2];
        uint16_t corners[3];
    } face[faces];
    const faqem_mesh wide = flat_grid(20);
    CHECK(wide.face_count == faces);
    memset(face, 0xff, sizeof face);
    for (size_t f = 0; f < faces; ++f)
        for (size_t k = 0; k < 3; ++k)
            corners[3 * f + k] = face[f].corners[k] = columns[k * faces + f] =
                (uint16_t)wide.triangles[3 * f + k];
    faqem_mesh mesh = wide;
    mesh.triangles = NULL;
    mesh.short_triangles = corners;
    a_flat_square_is_preserved(mesh);
    faqem_result *short_result = NULL, *wide_result = NULL;
    CHECK(faqem_simplify(&mesh, NULL, &short_result, NULL) == FAQEM_OK);
    CHECK(faqem_simplify(&wide, NULL, &wide_result, NULL) == FAQEM_OK);
    CHECK(faqem_result_face_count(short_result) == faqem_result_face_count(wide_result));
    CHECK(memcmp(faqem_result_triangles(short_result), faqem_result_triangles(wide_result),
                 3 * faqem_result_face_count(wide_result) * sizeof(uint32_t)) == 0);
    faqem_result_destroy(short_result);
    faqem_result_destroy(wide_result);

    mesh.short_triangles = face[0].corners;
    mesh.triangle_stride = sizeof face[0];
    a_flat_square_is_preserved(mesh);
    mesh.short_triangles = columns;
    mesh.triangle_stride = sizeof columns[0];
    mesh.triangle_step = faces * sizeof columns[0];
    a_flat_square_is_preserved(mesh);

    mesh.triangles = wide.triangles;
    check_rejected(&mesh, "16 bits");
}

static void groups_locks_and_weights_are_used(void) {
    faqem_mesh mesh = flat_grid(8);
    uint32_t groups[128];
    uint8_t locks[81];
    float weights[81];
    for (int f = 0; f < 128; ++f) groups[f] = f < 64 ? 7 : 9;
    memset(locks, 1, sizeof locks);
    for (int v = 0; v < 81; ++v) weights[v] = 1;
    mesh.face_groups = groups;
    mesh.vertex_locks = locks;
    mesh.vertex_weights = weights;
    faqem_options* options = faqem_options_create();
    faqem_options_set(options, "boundary", "locked", NULL);
    faqem_result* result = NULL;
    CHECK(faqem_simplify(&mesh, options, &result, NULL) == FAQEM_OK);
    CHECK(faqem_result_face_count(result) == 128);  // all vertices are locked
    for (size_t f = 0; f < 128; ++f)
        CHECK(faqem_result_face_groups(result)[f] == groups[faqem_result_face_origin(result)[f]]);
    faqem_report report;
    CHECK(faqem_result_report(result, &report) == FAQEM_OK);
    CHECK(report.stop == FAQEM_STOP_NO_LEGAL_COLLAPSE);
    faqem_result_destroy(result);

    weights[5] = NAN;
    faqem_error error;
    result = NULL;
    CHECK(faqem_simplify(&mesh, options, &result, &error) == FAQEM_ERROR_INPUT);
    CHECK(result == NULL);
    faqem_options_destroy(options);
}

static void the_distance_is_reported(void) {
    const faqem_mesh mesh = flat_grid(20);
    faqem_options* options = faqem_options_create();
    faqem_options_set_max_error(options, 0.001, FAQEM_UNIT_DIAGONAL);
    faqem_result* result = NULL;
    CHECK(faqem_simplify(&mesh, options, &result, NULL) == FAQEM_OK);
    faqem_report report;
    CHECK(faqem_result_report(result, &report) == FAQEM_OK);
    CHECK(report.stop == FAQEM_STOP_REACHED_MAX_ERROR && report.within_max_error == 1);
    CHECK(report.error_value <= report.error_bound);
    CHECK(report.error_bound <= 0.001 * sqrt(800) * (1 + 1e-12));
    faqem_result_destroy(result);
    faqem_options_destroy(options);
}

static void invalid_arrays_are_rejected_by_name(void) {
    const faqem_mesh mesh = flat_grid(2);
    faqem_mesh bad = mesh;
    bad.positions = NULL;
    check_rejected(&bad, "positions");
    bad = mesh;
    bad.double_positions = flat_grid_of_doubles(2).double_positions;
    check_rejected(&bad, "");
    bad = mesh;
    bad.triangles = NULL;
    check_rejected(&bad, "triangles");
    bad = mesh;
    bad.vertex_count = 8;  // the last vertex is referenced by face 6
    check_rejected(&bad, "face 6");
    bad.vertex_count = SIZE_MAX;
    check_rejected(&bad, "");
    bad = mesh;
    bad.face_count = SIZE_MAX / 3 + 1;
    check_rejected(&bad, "");
    float positions[27];
    memcpy(positions, mesh.positions, sizeof positions);
    positions[4] = INFINITY;
    bad = mesh;
    bad.positions = positions;
    check_rejected(&bad, "");

    faqem_result* result = NULL;
    faqem_error error;
    CHECK(faqem_simplify(NULL, NULL, &result, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_simplify(&mesh, NULL, NULL, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_simplify(NULL, NULL, NULL, NULL) == FAQEM_ERROR_OPTION);
    CHECK(result == NULL);
}

static void empty_meshes_and_null_arguments_are_accepted(void) {
    faqem_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    faqem_result* result = NULL;
    CHECK(faqem_simplify(&mesh, NULL, &result, NULL) == FAQEM_OK);
    CHECK(faqem_result_vertex_count(result) == 0 && faqem_result_face_count(result) == 0);
    CHECK(faqem_result_positions(result) == NULL && faqem_result_triangles(result) == NULL);
    faqem_result_destroy(result);

    faqem_result_destroy(NULL);
    CHECK(faqem_result_vertex_count(NULL) == 0 && faqem_result_face_count(NULL) == 0);
    CHECK(faqem_result_positions(NULL) == NULL && faqem_result_triangles(NULL) == NULL);
    CHECK(faqem_result_face_groups(NULL) == NULL && faqem_result_vertex_origin(NULL) == NULL);
    CHECK(faqem_result_face_origin(NULL) == NULL && faqem_result_report_json(NULL) == NULL);
    faqem_report report;
    CHECK(faqem_result_report(NULL, &report) == FAQEM_ERROR_OPTION);
}

void test_simplify(void) {
    a_flat_square_is_preserved(flat_grid(20));
    a_flat_square_is_preserved(flat_grid_of_doubles(20));
    arrays_may_have_any_stride_and_step();
    indices_may_have_16_bits();
    groups_locks_and_weights_are_used();
    the_distance_is_reported();
    invalid_arrays_are_rejected_by_name();
    empty_meshes_and_null_arguments_are_accepted();
}
