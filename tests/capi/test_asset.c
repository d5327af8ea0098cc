#include "faqem/faqem_asset.h"

#include <string.h>

#include "check.h"

static const char file[] = "test_c.glb";

static void a_model_is_saved_loaded_and_simplified(void) {
    const faqem_mesh mesh = flat_grid(12);
    faqem_error error;
    faqem_asset* created = NULL;
    CHECK(faqem_asset_create(&mesh, &created, &error) == FAQEM_OK);
    CHECK(faqem_asset_save(created, file, FAQEM_OVERWRITE_YES, &error) == FAQEM_OK);
    CHECK(faqem_asset_save(created, file, FAQEM_OVERWRITE_NO, &error) == FAQEM_ERROR_WRITE);
    CHECK(strstr(error.message, file) != NULL);
    CHECK(faqem_asset_report_json(created) == NULL);
    faqem_report report;
    CHECK(faqem_asset_report(created, &report) == FAQEM_ERROR_OPTION);
    faqem_asset_destroy(created);

    faqem_asset* loaded = NULL;
    CHECK(faqem_asset_load(file, &loaded, &error) == FAQEM_OK);
    CHECK(faqem_asset_part_count(loaded) == 1);
    CHECK(faqem_asset_vertex_count(loaded, 0) == 169 && faqem_asset_face_count(loaded, 0) == 288);
    CHECK(memcmp(faqem_asset_triangles(loaded, 0), mesh.triangles, 3 * 288 * sizeof(uint32_t)) == 0);
    for (size_t i = 0; i < 3 * 169; ++i) CHECK(faqem_asset_positions(loaded, 0)[i] == mesh.positions[i]);
    CHECK(faqem_asset_part_name(loaded, 0) != NULL);

    faqem_options* options = faqem_options_create();
    CHECK(faqem_options_set_faces(options, 50) == FAQEM_OK);
    static const char* const values[][2] = {
        {"visibility", "weighted"}, {"bake", "none"},    {"texture-size", "128"},    {"texel-density", "0.5"},
        {"normal-map", "off"},      {"normals", "flat"}, {"image-format", "jpeg:80"}};
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i)
        CHECK(faqem_options_set(options, values[i][0], values[i][1], &error) == FAQEM_OK);
    faqem_asset* simplified = NULL;
    CHECK(faqem_asset_simplify(loaded, options, &simplified, &error) == FAQEM_OK);
    CHECK(faqem_asset_face_count(simplified, 0) <= 50 && faqem_asset_face_count(simplified, 0) > 0);
    CHECK(faqem_asset_report(simplified, &report) == FAQEM_OK);
    CHECK(report.faces_in == 288 && report.faces_out == faqem_asset_face_count(simplified, 0));
    CHECK(strstr(faqem_asset_report_json(simplified), "\"faces_in\": 288") != NULL);

    faqem_asset* baked = NULL;
    CHECK(faqem_options_set(options, "bake", "auto", &error) == FAQEM_OK);
    CHECK(faqem_asset_bake_onto(loaded, simplified, "new", "1%", options, &baked, &error) == FAQEM_OK);
    CHECK(faqem_asset_face_count(baked, 0) == faqem_asset_face_count(simplified, 0));
    CHECK(strstr(faqem_asset_report_json(baked), "\"missing_texels\": 0.0") != NULL);
    faqem_asset_destroy(baked);
    CHECK(faqem_options_set(options, "compress", "none", &error) == FAQEM_OK);
    CHECK(faqem_options_set(options, "uv-bits", "12", &error) == FAQEM_OK);
    CHECK(faqem_asset_bake_onto(loaded, simplified, "", "", options, &baked, &error) == FAQEM_OK);
    CHECK(strstr(faqem_asset_report_json(baked), "uv_bits has no effect") != NULL);
    CHECK(faqem_asset_bake_onto(loaded, simplified, "old", NULL, NULL, &baked, &error) == FAQEM_ERROR_OPTION);
    CHECK(strstr(error.message, "'old' is not auto, keep or new") != NULL);
    faqem_asset_destroy(baked);

    faqem_asset* none = NULL;
    CHECK(faqem_options_set(options, "texture-size", "100", &error) == FAQEM_ERROR_OPTION);
    CHECK(strstr(error.message, "texture-size") != NULL);
    CHECK(faqem_options_set(options, "bake", "atlas", &error) == FAQEM_OK);
    CHECK(faqem_options_set(options, "normals", "none", &error) == FAQEM_OK);  // not with a new atlas
    CHECK(faqem_asset_simplify(loaded, options, &none, &error) == FAQEM_ERROR_OPTION);
    CHECK(none == NULL && strstr(error.message, "normals") != NULL);
    faqem_options_destroy(options);
    faqem_asset_destroy(loaded);
    faqem_asset_destroy(simplified);
    CHECK(remove(file) == 0);
}

static void a_model_is_passed_as_bytes(void) {
    const faqem_mesh mesh = flat_grid(4);
    faqem_asset *created = NULL, *read = NULL;
    faqem_glb* glb = NULL;
    faqem_error error;
    size_t size = 1;
    CHECK(faqem_asset_create(&mesh, &created, &error) == FAQEM_OK);
    CHECK(faqem_asset_to_glb(created, &glb, &error) == FAQEM_OK);
    CHECK(memcmp(faqem_glb_bytes(glb, &size), "glTF", 4) == 0 && size > 25 * 12);
    CHECK(faqem_asset_from_glb(faqem_glb_bytes(glb, NULL), size, &read, &error) == FAQEM_OK);
    CHECK(faqem_asset_vertex_count(read, 0) == 25 && faqem_asset_face_count(read, 0) == 32);
    faqem_asset_destroy(read);
    read = NULL;
    CHECK(faqem_asset_from_glb(faqem_glb_bytes(glb, NULL), size / 2, &read, &error) == FAQEM_ERROR_INPUT);
    CHECK(faqem_asset_from_glb(NULL, 0, &read, &error) == FAQEM_ERROR_OPTION && read == NULL);
    CHECK(faqem_glb_bytes(NULL, &size) == NULL && size == 0);
    faqem_glb_destroy(glb);
    faqem_glb_destroy(NULL);
    faqem_asset_destroy(created);
}

static void errors_have_file_name_and_status(void) {
    faqem_asset* asset = NULL;
    faqem_error error;
    CHECK(faqem_asset_load("not-there.glb", &asset, &error) == FAQEM_ERROR_INPUT);
    CHECK(strstr(error.message, "not-there.glb") != NULL);
    FILE* unknown = fopen("test_c.xyz", "w");
    CHECK(unknown && fputs("1 2 3", unknown) >= 0 && fclose(unknown) == 0);
    CHECK(faqem_asset_load("test_c.xyz", &asset, &error) == FAQEM_ERROR_UNSUPPORTED);
    CHECK(remove("test_c.xyz") == 0);
    CHECK(faqem_asset_load(NULL, &asset, &error) == FAQEM_ERROR_OPTION);
    CHECK(asset == NULL);

    /* A name that is longer than the message buffer: the message is truncated and ends with " ...". */
    char name[4000];
    memset(name, 'x', sizeof name);
    name[sizeof name - 1] = '\0';
    CHECK(faqem_asset_load(name, &asset, &error) != FAQEM_OK);
    CHECK(strlen(error.message) == sizeof error.message - 1);
    CHECK(strcmp(error.message + sizeof error.message - 5, " ...") == 0);

    const uint32_t corners[3] = {0, 1, 9};
    faqem_mesh mesh = flat_grid(1);
    mesh.triangles = corners;
    mesh.face_count = 1;
    CHECK(faqem_asset_create(&mesh, &asset, &error) == FAQEM_ERROR_INPUT);
    CHECK(strstr(error.message, "9") != NULL);
}

static void data_that_the_format_cannot_store_is_a_warning(void) {
    const faqem_mesh mesh = flat_grid_of_doubles(2);
    faqem_asset* asset = NULL;
    CHECK(faqem_asset_create(&mesh, &asset, NULL) == FAQEM_OK);
    CHECK(faqem_asset_warning_count(asset) == 0 && faqem_asset_warning(asset, 0) == NULL);
    CHECK(faqem_asset_save(asset, "test_c.off", FAQEM_OVERWRITE_YES, NULL) == FAQEM_ERROR_UNSUPPORTED);
    CHECK(faqem_asset_save(asset, file, (faqem_overwrite)5, NULL) == FAQEM_ERROR_OPTION);
    faqem_asset_destroy(asset);

    FILE* coloured = fopen("test_c.ply", "w");
    CHECK(coloured && fputs("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                            "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
                            "property uchar blue\nproperty float quality\nelement face 1\n"
                            "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0 1\n"
                            "1 0 0 0 255 0 1\n0 1 0 0 0 255 1\n3 0 1 2\n",
                            coloured) >= 0);
    CHECK(fclose(coloured) == 0);
    CHECK(faqem_asset_load("test_c.ply", &asset, NULL) == FAQEM_OK);
    CHECK(faqem_asset_warning_count(asset) == 0 && faqem_asset_not_understood_count(asset) == 1);
    CHECK(strcmp(faqem_asset_not_understood(asset, 0), "property 'quality' of vertex") == 0);
    CHECK(faqem_asset_not_understood(asset, 1) == NULL);
    CHECK(faqem_asset_save(asset, "test_c.stl", FAQEM_OVERWRITE_YES, NULL) == FAQEM_OK);
    CHECK(faqem_asset_warning_count(asset) > 0);
    CHECK(strstr(faqem_asset_warning(asset, 0), "STL") != NULL);
    faqem_asset_destroy(asset);
    CHECK(remove("test_c.ply") == 0 && remove("test_c.stl") == 0);
}

static void null_arguments_are_accepted(void) {
    faqem_asset_destroy(NULL);
    CHECK(faqem_asset_part_count(NULL) == 0 && faqem_asset_part_name(NULL, 0) == NULL);
    CHECK(faqem_asset_vertex_count(NULL, 0) == 0 && faqem_asset_face_count(NULL, 0) == 0);
    CHECK(faqem_asset_positions(NULL, 0) == NULL && faqem_asset_triangles(NULL, 0) == NULL);
    CHECK(faqem_asset_not_understood_count(NULL) == 0 && faqem_asset_not_understood(NULL, 0) == NULL);
    CHECK(faqem_asset_warning_count(NULL) == 0 && faqem_asset_report_json(NULL) == NULL);
    CHECK(faqem_asset_simplify(NULL, NULL, NULL, NULL) == FAQEM_ERROR_OPTION);
}

void test_asset(void) {
    a_model_is_saved_loaded_and_simplified();
    a_model_is_passed_as_bytes();
    errors_have_file_name_and_status();
    data_that_the_format_cannot_store_is_a_warning();
    null_arguments_are_accepted();
}
