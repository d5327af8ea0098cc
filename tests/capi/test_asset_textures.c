#include <string.h>

#include "check.h"
#include "faqem/faqem_asset.h"

static faqem_asset* load_quad(void) {
    faqem_asset* quad = NULL;
    CHECK(faqem_asset_load(FAQEM_TEST_DATA "/textured_quad.glb", &quad, NULL) == FAQEM_OK);
    return quad;
}

static void uvs_and_materials_are_arrays_of_the_model(void) {
    faqem_asset* quad = load_quad();
    CHECK(faqem_asset_uv_set_count(quad, 0) == 1 && faqem_asset_uv_set_count(quad, 1) == 0);
    const float* uvs = faqem_asset_uvs(quad, 0, 0);
    CHECK(uvs && !faqem_asset_uvs(quad, 0, 1) && !faqem_asset_uvs(quad, 1, 0));
    for (size_t i = 0; i < 2 * faqem_asset_vertex_count(quad, 0); ++i) CHECK(uvs[i] >= 0 && uvs[i] <= 1);
    const uint32_t* materials = faqem_asset_face_materials(quad, 0);
    CHECK(materials && materials[0] == 0 && materials[1] == 0 && !faqem_asset_face_materials(quad, 1));

    CHECK(faqem_asset_material_count(quad) == 1);
    CHECK(faqem_asset_material_name(quad, 0) && !faqem_asset_material_name(quad, 1));
    uint32_t set = 7;
    CHECK(faqem_asset_material_image(quad, 0, FAQEM_TEXTURE_NORMAL, &set) == UINT32_MAX && set == 7);
    CHECK(faqem_asset_material_image(quad, 0, (faqem_texture)99, &set) == UINT32_MAX && set == 7);
    CHECK(faqem_asset_material_image(quad, 1, FAQEM_TEXTURE_BASE_COLOR, &set) == UINT32_MAX && set == 7);
    CHECK(faqem_asset_material_image(quad, 0, FAQEM_TEXTURE_BASE_COLOR, NULL) == 0);
    CHECK(faqem_asset_material_image(quad, 0, FAQEM_TEXTURE_BASE_COLOR, &set) == 0 && set == 0);
    faqem_asset_destroy(quad);
}

static void images_are_decoded(void) {
    faqem_asset* quad = load_quad();
    CHECK(faqem_asset_image_count(quad) == 1);
    CHECK(strcmp(faqem_asset_image_name(quad, 0), "checkers") == 0);
    CHECK(strcmp(faqem_asset_image_mime_type(quad, 0), "image/png") == 0);
    size_t size = 0;
    const uint8_t* bytes = faqem_asset_image_bytes(quad, 0, &size);
    CHECK(bytes && size == 368 && memcmp(bytes + 1, "PNG", 3) == 0 &&
          faqem_asset_image_bytes(quad, 0, NULL) == bytes);
    CHECK(!faqem_asset_image_bytes(quad, 1, &size) && size == 0);

    faqem_pixels* pixels = NULL;
    faqem_error error;
    CHECK(faqem_asset_decode_image(quad, 1, &pixels, &error) == FAQEM_ERROR_OPTION && !pixels);
    CHECK(strstr(error.message, "image: 1") != NULL);
    CHECK(faqem_asset_decode_image(quad, 0, NULL, &error) == FAQEM_ERROR_OPTION);
    CHECK(faqem_asset_decode_image(quad, 0, &pixels, &error) == FAQEM_OK);
    faqem_asset_destroy(quad);  // the pixels do not refer to it
    CHECK(faqem_pixels_width(pixels) == 64 && faqem_pixels_height(pixels) == 64);
    CHECK(faqem_pixels_has_alpha(pixels) == 0);
    const uint8_t top_left[3] = {40, 40, 90};
    const uint8_t* rgba = faqem_pixels_rgba(pixels);
    for (size_t i = 0; i < (size_t)64 * 64; ++i) CHECK(rgba[4 * i + 3] == 255);
    CHECK(memcmp(rgba, top_left, sizeof top_left) == 0);
    faqem_pixels_destroy(pixels);
}

static void null_arguments_are_accepted(void) {
    CHECK(faqem_asset_uv_set_count(NULL, 0) == 0 && !faqem_asset_uvs(NULL, 0, 0) &&
          !faqem_asset_face_materials(NULL, 0));
    CHECK(faqem_asset_material_count(NULL) == 0 && !faqem_asset_material_name(NULL, 0));
    CHECK(faqem_asset_material_image(NULL, 0, FAQEM_TEXTURE_BASE_COLOR, NULL) == UINT32_MAX);
    CHECK(faqem_asset_image_count(NULL) == 0 && !faqem_asset_image_name(NULL, 0));
    CHECK(!faqem_asset_image_mime_type(NULL, 0) && !faqem_asset_image_bytes(NULL, 0, NULL));
    CHECK(faqem_asset_decode_image(NULL, 0, NULL, NULL) == FAQEM_ERROR_OPTION);
    CHECK(faqem_pixels_width(NULL) == 0 && faqem_pixels_height(NULL) == 0 &&
          faqem_pixels_has_alpha(NULL) == 0);
    CHECK(!faqem_pixels_rgba(NULL));
    faqem_pixels_destroy(NULL);
}

void test_asset_textures(void) {
    uvs_and_materials_are_arrays_of_the_model();
    images_are_decoded();
    null_arguments_are_accepted();
}
