#include <math.h>
#include <string.h>

#include "check.h"
#include "faqem/faqem_asset.h"

static float height(const float* at, int part) {
    return (float)((part + 0.2) * sin(at[0] / 2) * cos(at[1] / 3));
}

/* Returns a wavy square with vertex colours. */
static faqem_asset* coloured_wave(void) {
    FILE* file = fopen("test_c.obj", "w");
    CHECK(file != NULL);
    const faqem_mesh mesh = flat_grid(12);
    for (size_t v = 0; v < mesh.vertex_count; ++v) {
        const float* at = mesh.positions + 3 * v;
        CHECK(fprintf(file, "v %g %g %.9g 1 %d 0\n", at[0], at[1], height(at, 0), (int)at[0] / 7) > 0);
    }
    for (size_t f = 0; f < mesh.face_count; ++f) {
        const uint32_t* t = mesh.triangles + 3 * f;
        CHECK(fprintf(file, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1) > 0);
    }
    CHECK(fclose(file) == 0);
    faqem_asset* source = NULL;
    CHECK(faqem_asset_load("test_c.obj", &source, NULL) == FAQEM_OK);
    CHECK(remove("test_c.obj") == 0);
    return source;
}

/* Returns a scene with two meshes. The second has larger waves and is translated. */
static faqem_asset* two_waves(void) {
    static const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
        "\"nodes\":[{\"mesh\":0},{\"mesh\":1,\"translation\":[0,0,20]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":1},\"indices\":2}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":169,\"type\":\"VEC3\","
        "\"min\":[0,0,-2],\"max\":[12,12,2]},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":169,\"type\":\"VEC3\",\"min\":[0,0,-2],\"max\":["
        "12,12,2]},"
        "{\"bufferView\":2,\"componentType\":5125,\"count\":864,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":2028},{\"buffer\":0,\"byteOffset\":2028,"
        "\"byteLength\":2028},"
        "{\"buffer\":0,\"byteOffset\":4056,\"byteLength\":3456}],"
        "\"buffers\":[{\"uri\":\"test_c.bin\",\"byteLength\":7512}]}";
    const faqem_mesh mesh = flat_grid(12);
    FILE* numbers = fopen("test_c.bin", "wb");
    CHECK(numbers != NULL);
    for (int part = 0; part < 2; ++part) {
        for (size_t v = 0; v < mesh.vertex_count; ++v) {
            const float at[3] = {mesh.positions[3 * v], mesh.positions[3 * v + 1],
                                 height(mesh.positions + 3 * v, part)};
            CHECK(fwrite(at, sizeof at, 1, numbers) == 1);
        }
    }
    CHECK(fwrite(mesh.triangles, 12, mesh.face_count, numbers) == mesh.face_count && fclose(numbers) == 0);
    FILE* file = fopen("test_c.gltf", "w");
    CHECK(file && fputs(json, file) >= 0 && fclose(file) == 0);
    faqem_asset* source = NULL;
    CHECK(faqem_asset_load("test_c.gltf", &source, NULL) == FAQEM_OK);
    CHECK(faqem_asset_part_count(source) == 2 && faqem_asset_face_count(source, 1) == 288);
    CHECK(remove("test_c.gltf") == 0 && remove("test_c.bin") == 0);
    return source;
}

static faqem_options* small_textures(void) {
    faqem_options* options = faqem_options_create();
    CHECK(faqem_options_set(options, "texture-size", "64", NULL) == FAQEM_OK);
    return options;
}

static void levels_have_separate_or_shared_textures(void) {
    faqem_asset* source = coloured_wave();
    CHECK(faqem_asset_level_error(source) != faqem_asset_level_error(source));
    faqem_options* options = small_textures();
    const faqem_level wanted[2] = {{FAQEM_LEVEL_RATIO, 0.5}, {FAQEM_LEVEL_FACES, 40}};
    faqem_error error;
    for (int textures = FAQEM_LEVEL_TEXTURES_EACH; textures <= FAQEM_LEVEL_TEXTURES_SHARED; ++textures) {
        faqem_asset* levels[2] = {NULL, NULL};
        CHECK(faqem_asset_simplify_levels(source, options, wanted, 2, (faqem_level_textures)textures, levels,
                                          &error) == FAQEM_OK);
        faqem_report report;
        for (int i = 0; i < 2; ++i) {
            CHECK(faqem_asset_report(levels[i], &report) == FAQEM_OK);
            CHECK(report.faces_in == 288 && report.faces_out == faqem_asset_face_count(levels[i], 0));
            CHECK(report.faces_out <= (i == 0 ? 144 : 40));
        }
        CHECK(faqem_asset_level_error(levels[0]) >= 0);
        CHECK(faqem_asset_level_error(levels[1]) >= faqem_asset_level_error(levels[0]));
        /* With a shared texture only the finest level has a page. */
        const int has_pages = strstr(faqem_asset_report_json(levels[1]), "\"charts\"") != NULL;
        CHECK(has_pages == (textures == FAQEM_LEVEL_TEXTURES_EACH));
        faqem_asset_destroy(levels[0]);
        faqem_asset_destroy(levels[1]);
    }
    faqem_asset* none[2] = {NULL, NULL};
    CHECK(faqem_asset_simplify_levels(source, options, wanted, 2, (faqem_level_textures)7, none, &error) ==
          FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set_faces(options, 10) == FAQEM_OK);
    CHECK(faqem_asset_simplify_levels(source, options, wanted, 2, FAQEM_LEVEL_TEXTURES_EACH, none, &error) ==
          FAQEM_ERROR_OPTION);
    CHECK(none[0] == NULL && none[1] == NULL);
    faqem_options_destroy(options);
    faqem_asset_destroy(source);
}

static int same_parts(const faqem_asset* a, const faqem_asset* b) {
    int same = faqem_asset_part_count(a) == faqem_asset_part_count(b);
    for (size_t p = 0; same && p < faqem_asset_part_count(a); ++p) {
        const size_t v = faqem_asset_vertex_count(a, p), f = faqem_asset_face_count(a, p);
        same =
            v == faqem_asset_vertex_count(b, p) && f == faqem_asset_face_count(b, p) &&
            memcmp(faqem_asset_positions(a, p), faqem_asset_positions(b, p), 3 * v * sizeof(double)) == 0 &&
            memcmp(faqem_asset_triangles(a, p), faqem_asset_triangles(b, p), 3 * f * sizeof(uint32_t)) == 0;
    }
    return same;
}

static void a_history_of_several_meshes_reproduces_every_level(void) {
    faqem_asset *source = two_waves(), *other = coloured_wave();
    faqem_options* options = small_textures();
    CHECK(faqem_options_set_history(options, FAQEM_RECORDING_ON) == FAQEM_OK);
    const faqem_level wanted[2] = {{FAQEM_LEVEL_FACES, 300}, {FAQEM_LEVEL_FACES, 60}};
    faqem_asset* levels[2] = {NULL, NULL};
    faqem_error error;
    CHECK(faqem_asset_simplify_levels(source, options, wanted, 2, FAQEM_LEVEL_TEXTURES_EACH, levels,
                                      &error) == FAQEM_OK);
    faqem_history *made = NULL, *history = NULL;
    CHECK(faqem_asset_history_create((const faqem_asset* const*)levels, 2, &made, &error) == FAQEM_OK);
    size_t size = 0;
    const uint8_t* bytes = faqem_history_bytes(made, &size);
    CHECK(faqem_history_read(bytes, size, &history, &error) == FAQEM_OK);
    CHECK(faqem_history_part_count(history) == 2 && faqem_history_level_count(history) == 2);
    for (int i = 0; i < 2; ++i) {
        faqem_asset* cut = NULL;
        CHECK(faqem_asset_bake_truncated(source, history, (uint64_t)wanted[i].value, options, &cut, &error) ==
              FAQEM_OK);
        CHECK(same_parts(cut, levels[i]));
        faqem_asset_destroy(cut);
    }
    faqem_result* parts[2] = {NULL, NULL};
    CHECK(faqem_history_truncate(history, 150, parts, &error) == FAQEM_ERROR_OPTION && parts[0] == NULL);
    CHECK(strstr(error.message, "2 meshes") != NULL);
    CHECK(faqem_history_truncate_parts(history, 150, parts, &error) == FAQEM_OK);
    const size_t faces = faqem_result_face_count(parts[0]) + faqem_result_face_count(parts[1]);
    CHECK(faces <= 150 && faces > 140);
    for (int i = 0; i < 2; ++i) faqem_result_destroy(parts[i]);

    faqem_asset* none = NULL;
    CHECK(faqem_asset_bake_truncated(other, history, 150, options, &none, &error) == FAQEM_ERROR_INPUT);
    CHECK(faqem_asset_bake_truncated(levels[0], history, 150, options, &none, &error) == FAQEM_ERROR_INPUT);
    CHECK(faqem_asset_bake_truncated(source, history, 0, options, &none, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_asset_bake_truncated(source, NULL, 150, options, &none, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_options_set(options, "bake", "keep", NULL) == FAQEM_OK);
    CHECK(faqem_asset_bake_truncated(source, history, 150, options, &none, &error) == FAQEM_ERROR_OPTION);
    CHECK(none == NULL && faqem_history_part_count(NULL) == 0);
    faqem_history* no_history = NULL;
    CHECK(faqem_asset_history_create((const faqem_asset* const*)&source, 1, &no_history, &error) ==
          FAQEM_ERROR_OPTION);
    CHECK(faqem_asset_history_create(NULL, 1, &no_history, &error) == FAQEM_ERROR_OPTION &&
          no_history == NULL);
    faqem_history_destroy(made);
    faqem_history_destroy(history);
    for (int i = 0; i < 2; ++i) faqem_asset_destroy(levels[i]);
    faqem_asset_destroy(source);
    faqem_asset_destroy(other);
    faqem_options_destroy(options);
}

static void levels_are_saved_in_one_file(void) {
    faqem_asset* chain[3] = {two_waves(), NULL, NULL};
    faqem_options* options = small_textures();
    CHECK(faqem_options_set(options, "normal-map", "on", NULL) == FAQEM_OK);
    CHECK(faqem_options_set(options, "image-format", "png", NULL) == FAQEM_OK);
    const faqem_level wanted[2] = {{FAQEM_LEVEL_RATIO, 0.5}, {FAQEM_LEVEL_FACES, 40}};
    faqem_error error;
    CHECK(faqem_asset_simplify_levels(chain[0], options, wanted, 2, FAQEM_LEVEL_TEXTURES_EACH, chain + 1,
                                      &error) == FAQEM_OK);
    const char* const path = "test_c_lod.gltf";
    CHECK(faqem_asset_save_levels(chain, 3, 1.0 / 1080, path, FAQEM_OVERWRITE_YES, &error) == FAQEM_OK);
    CHECK(faqem_asset_save_levels(chain, 3, 1.0 / 1080, path, FAQEM_OVERWRITE_NO, &error) ==
          FAQEM_ERROR_WRITE);
    CHECK(faqem_asset_save_levels(chain, 3, NAN, path, FAQEM_OVERWRITE_YES, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_asset_save_levels(chain, 3, 0, path, FAQEM_OVERWRITE_YES, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_asset_save_levels(chain, 0, 1, path, FAQEM_OVERWRITE_YES, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_asset_save_levels(chain, 3, 1, "test_c_lod.obj", FAQEM_OVERWRITE_YES, &error) ==
          FAQEM_ERROR_UNSUPPORTED);

    static char text[1 << 22];
    FILE* in = fopen(path, "r");
    CHECK(in != NULL);
    text[fread(text, 1, sizeof text - 1, in)] = '\0';
    CHECK(fclose(in) == 0);
    CHECK(strstr(text, "MSFT_lod") != NULL && strstr(text, "MSFT_screencoverage") != NULL);
    faqem_asset* read = NULL;
    CHECK(faqem_asset_load(path, &read, &error) == FAQEM_OK);
    CHECK(faqem_asset_part_count(read) == 6); /* the parts of the first level come first */
    for (size_t p = 0; p < 2; ++p) CHECK(faqem_asset_face_count(read, p) == 288);
    size_t faces = 0;
    for (size_t p = 0; p < 6; ++p) faces += faqem_asset_face_count(read, p);
    CHECK(faces <= 576 + 288 + 40 && faces > 576 + 280 + 30);
    faqem_asset_destroy(read);
    for (int i = 0; i < 3; ++i) faqem_asset_destroy(chain[i]);
    faqem_options_destroy(options);
    CHECK(remove(path) == 0 && remove("test_c_lod.bin") == 0);
    CHECK(remove("test_c_lod_0.png") == 0 && remove("test_c_lod_1.png") == 0);
}

void test_asset_levels(void) {
    levels_have_separate_or_shared_textures();
    a_history_of_several_meshes_reproduces_every_level();
    levels_are_saved_in_one_file();
}
