#include <math.h>
#include <string.h>

#include "check.h"

static uint64_t faces_with(const faqem_options* options) {
    const faqem_mesh mesh = flat_grid(20);
    faqem_result* result = NULL;
    CHECK(faqem_simplify(&mesh, options, &result, NULL) == FAQEM_OK);
    const size_t faces = faqem_result_face_count(result);
    faqem_result_destroy(result);
    return faces;
}

static void the_last_target_is_used(void) {
    faqem_options* options = faqem_options_create();
    faqem_options_set_ratio(options, 0.5);
    faqem_options_set_faces(options, 100);
    CHECK(faces_with(options) <= 100);
    faqem_options_set_ratio(options, 0.5);
    CHECK(faces_with(options) > 390 && faces_with(options) <= 400);
    faqem_options_destroy(options);
}

static void every_option_can_be_set(void) {
    faqem_options* options = faqem_options_create();
    for (int preset = FAQEM_PRESET_QEM; preset <= FAQEM_PRESET_BEST; ++preset) {
        CHECK(faqem_options_set_preset(options, (faqem_preset)preset) == FAQEM_OK);
        CHECK(faces_with(options) <= 80);
    }
    for (int link = FAQEM_LINK_AS_PRESET; link <= FAQEM_LINK_STRICT; ++link)
        CHECK(faqem_options_set_link(options, (faqem_link)link) == FAQEM_OK);
    CHECK(faqem_options_set_boundary(options, FAQEM_BOUNDARY_KEPT) == FAQEM_OK);
    CHECK(faqem_options_set_group_boundaries(options, FAQEM_BOUNDARY_KEPT) == FAQEM_OK);
    CHECK(faqem_options_set_weld_distance(options, 1e-9) == FAQEM_OK);
    CHECK(faqem_options_set_virtual_edges(options, 0.01) == FAQEM_OK);
    CHECK(faqem_options_set_prune(options, 0.1, FAQEM_UNIT_MODEL) == FAQEM_OK);
    CHECK(faqem_options_set_threads(options, 2) == FAQEM_OK);
    CHECK(faces_with(options) >= 78);  // a triangulation of the polygon with the 80 boundary vertices
    faqem_options_destroy(options);
}

static void values_out_of_range_are_rejected(void) {
    faqem_options* options = faqem_options_create();
    CHECK(faqem_options_set_preset(options, (faqem_preset)6) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_preset(options, (faqem_preset)-1) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_link(options, (faqem_link)99) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_boundary(options, (faqem_boundary)2) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_max_error(options, 1, (faqem_unit)2) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_prune(options, 1, (faqem_unit)-1) == FAQEM_ERROR_OPTION);
    CHECK(faces_with(options) <= 80);  // the options are unchanged

    CHECK(faqem_options_set_ratio(options, NAN) == FAQEM_OK);  // validated when the options are used
    const faqem_mesh mesh = flat_grid(4);
    faqem_result* result = NULL;
    faqem_error error;
    CHECK(faqem_simplify(&mesh, options, &result, &error) == FAQEM_ERROR_OPTION);
    CHECK(result == NULL && strstr(error.message, "ratio") != NULL);
    faqem_options_destroy(options);

    CHECK(faqem_options_set_ratio(NULL, 0.5) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_preset(NULL, FAQEM_PRESET_FAST) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_max_error(NULL, 1, FAQEM_UNIT_MODEL) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_progress(NULL, NULL, NULL) == FAQEM_ERROR_OPTION);
    faqem_options_destroy(NULL);
}

struct calls {
    int count, cancel_at;
};

static int count_call(void* user, faqem_phase phase, double fraction) {
    struct calls* calls = user;
    CHECK(phase >= FAQEM_PHASE_LOAD && phase <= FAQEM_PHASE_SAVE);
    CHECK(fraction >= 0 && fraction <= 1);
    return ++calls->count == calls->cancel_at;
}

static void the_progress_callback_is_called_and_may_cancel(void) {
    faqem_options* options = faqem_options_create();
    struct calls calls = {0, -1};
    CHECK(faqem_options_set_progress(options, count_call, &calls) == FAQEM_OK);
    CHECK(faces_with(options) <= 80);
    CHECK(calls.count > 0);

    calls.count = 0;
    calls.cancel_at = 1;
    const faqem_mesh mesh = flat_grid(20);
    faqem_result* result = NULL;
    faqem_error error;
    CHECK(faqem_simplify(&mesh, options, &result, &error) == FAQEM_ERROR_CANCELLED);
    CHECK(result == NULL && error.status == FAQEM_ERROR_CANCELLED);

    CHECK(faqem_options_set_progress(options, NULL, NULL) == FAQEM_OK);
    CHECK(faces_with(options) <= 80);
    CHECK(calls.count == 1);
    faqem_options_destroy(options);
}

static void the_version_has_three_numbers(void) {
    int major = -1, minor = -1, patch = -1;
    char rest = 0;
    CHECK(sscanf(faqem_version(), "%d.%d.%d%c", &major, &minor, &patch, &rest) == 3);
}

void test_options(void) {
    the_last_target_is_used();
    every_option_can_be_set();
    values_out_of_range_are_rejected();
    the_progress_callback_is_called_and_may_cancel();
    the_version_has_three_numbers();
}
