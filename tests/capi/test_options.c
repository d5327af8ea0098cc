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
    static const char* const values[][2] = {
        {"link", "strict"},        {"boundary", "locked"},    {"group-boundaries", "preserved"},
        {"weld-distance", "1e-9"}, {"virtual-edges", "0.01"}, {"prune", "0.1"},
        {"threads", "2"},          {"w-area", "100"}};
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i)
        CHECK(faqem_options_set(options, values[i][0], values[i][1], NULL) == FAQEM_OK);
    CHECK(faces_with(options) >= 78);  // a triangulation of the polygon with the 80 boundary vertices
    faqem_options_destroy(options);
}

static void every_option_has_a_help_text(void) {
    for (size_t i = 0; i < faqem_option_count(); ++i) CHECK(strlen(faqem_option_help(i)) > 10);
    CHECK(faqem_option_help(faqem_option_count()) == NULL);
    for (size_t i = 0; i < faqem_option_count(); ++i) {
        const char* help = faqem_option_help(i);
        if (strcmp(faqem_option_name(i), "preset") == 0)
            CHECK(strstr(help, "|fast|balanced|best: ") != NULL && strstr(help, "; default: balanced") != NULL);
        if (strcmp(faqem_option_name(i), "samples") == 0) CHECK(strstr(help, "in [1, 8]") != NULL);
    }
    faqem_options* options = faqem_options_create();
    faqem_error error;
    CHECK(faqem_options_set(options, "keep-groups", "on", &error) == FAQEM_ERROR_OPTION);
    CHECK(strstr(error.message, "use group-boundaries='preserved'") != NULL);
    faqem_options_destroy(options);
}

static void values_out_of_range_are_rejected(void) {
    faqem_options* options = faqem_options_create();
    CHECK(faqem_options_set_preset(options, (faqem_preset)6) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_preset(options, (faqem_preset)-1) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set(options, "link", "maybe", NULL) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set(options, "boundary", "", NULL) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_max_error(options, 1, (faqem_unit)2) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set(options, "prune", "-1", NULL) == FAQEM_ERROR_OPTION);
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

static void errors_name_the_option_and_suggest_one(void) {
    faqem_options* options = faqem_options_create();
    faqem_error error;
    CHECK(faqem_options_set(options, "texel-density", "1.5", &error) == FAQEM_OK && error.message[0] == 0);
    CHECK(faqem_options_set(options, "texel-density", "9", &error) == FAQEM_ERROR_OPTION);
    CHECK(error.status == FAQEM_ERROR_OPTION);
    CHECK(strcmp(error.message, "texel-density must be in [0.125, 8], not 9") == 0);
    CHECK(faqem_options_set(options, "texel-densty", "1.5", &error) == FAQEM_ERROR_OPTION);
    CHECK(strcmp(error.message, "unknown option 'texel-densty'; did you mean 'texel-density'?") == 0);
    CHECK(faqem_options_set(options, "ratio", NULL, &error) == FAQEM_ERROR_OPTION);
    CHECK(strstr(error.message, "value") != NULL);
    CHECK(faqem_options_set(options, NULL, "1", NULL) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set(NULL, "ratio", "1", NULL) == FAQEM_ERROR_OPTION);
    faqem_options_destroy(options);
}

static void the_names_of_all_options_can_be_listed(void) {
    faqem_options* options = faqem_options_create();
    int ratios = 0;
    for (size_t i = 0; i < faqem_option_count(); ++i) {
        faqem_error error;
        const char* const name = faqem_option_name(i);
        CHECK(faqem_options_set(options, name, "?", &error) == FAQEM_ERROR_OPTION);
        CHECK(strncmp(error.message, name, strlen(name)) == 0);  // known, but its value is wrong
        ratios += strcmp(name, "ratio") == 0;
    }
    CHECK(ratios == 1);
    CHECK(faqem_option_name(faqem_option_count()) == NULL);
    faqem_options_destroy(options);
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

static void a_time_limit_is_a_stop_reason(void) {
    faqem_options* options = faqem_options_create();
    const faqem_mesh mesh = flat_grid(20);
    faqem_result* result = NULL;
    faqem_report report;
    CHECK(faqem_options_set(options, "max-seconds", "0", NULL) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set(options, "max-seconds", "1e-9", NULL) == FAQEM_OK);
    CHECK(faqem_simplify(&mesh, options, &result, NULL) == FAQEM_OK);
    CHECK(faqem_result_report(result, &report) == FAQEM_OK);
    CHECK(report.stop == FAQEM_STOP_REACHED_TIME_LIMIT && report.faces_out == 800);
    faqem_result_destroy(result);
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
    every_option_has_a_help_text();
    values_out_of_range_are_rejected();
    errors_name_the_option_and_suggest_one();
    the_names_of_all_options_can_be_listed();
    the_progress_callback_is_called_and_may_cancel();
    a_time_limit_is_a_stop_reason();
    the_version_has_three_numbers();
}
