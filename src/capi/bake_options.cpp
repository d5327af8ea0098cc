#include "capi/options.hpp"
#include "faqem/faqem_asset.h"

namespace {

using namespace faqem;
using faqem::capi::has_same_value;
using faqem::capi::set;
using faqem::capi::set_enum;

static_assert(has_same_value(FAQEM_VISIBILITY_IGNORED, Visibility::ignored) &&
              has_same_value(FAQEM_VISIBILITY_WEIGHTED, Visibility::weighted));
static_assert(has_same_value(FAQEM_BAKE_AUTOMATIC, Bake::automatic) &&
              has_same_value(FAQEM_BAKE_ATLAS, Bake::atlas) &&
              has_same_value(FAQEM_BAKE_PER_TRIANGLE, Bake::per_triangle) &&
              has_same_value(FAQEM_BAKE_VERTEX, Bake::vertex) &&
              has_same_value(FAQEM_BAKE_KEEP, Bake::keep) && has_same_value(FAQEM_BAKE_NONE, Bake::none));
static_assert(has_same_value(FAQEM_NORMAL_MAP_AUTOMATIC, NormalMap::automatic) &&
              has_same_value(FAQEM_NORMAL_MAP_ON, NormalMap::on) &&
              has_same_value(FAQEM_NORMAL_MAP_OFF, NormalMap::off));
static_assert(has_same_value(FAQEM_NORMALS_TRANSFER, Normals::transfer) &&
              has_same_value(FAQEM_NORMALS_SMOOTH, Normals::smooth) &&
              has_same_value(FAQEM_NORMALS_FLAT, Normals::flat) &&
              has_same_value(FAQEM_NORMALS_NONE, Normals::none));
static_assert(has_same_value(FAQEM_IMAGE_PNG, ImageFormat::png) &&
              has_same_value(FAQEM_IMAGE_JPEG, ImageFormat::jpeg) &&
              has_same_value(FAQEM_IMAGE_SOURCE, ImageFormat::source));

}  // namespace

faqem_status faqem_options_set_visibility(faqem_options* options, faqem_visibility visibility) {
    return set_enum(
        options, visibility, FAQEM_VISIBILITY_WEIGHTED, [](Options & o) -> auto& { return o.visibility; });
}

faqem_status faqem_options_set_bake(faqem_options* options, faqem_bake kind) {
    return set_enum(
        options, kind, FAQEM_BAKE_NONE, [](Options & o) -> auto& { return o.bake.kind; });
}

faqem_status faqem_options_set_texture_size(faqem_options* options, uint32_t texels) {
    return set(options, [&](Options& o) { o.bake.texture_size = texels; });
}

faqem_status faqem_options_set_texel_density(faqem_options* options, double factor) {
    return set(options, [&](Options& o) { o.bake.texel_density = factor; });
}

faqem_status faqem_options_set_normal_map(faqem_options* options, faqem_normal_map kind) {
    return set_enum(
        options, kind, FAQEM_NORMAL_MAP_OFF, [](Options & o) -> auto& { return o.bake.normal_map; });
}

faqem_status faqem_options_set_normals(faqem_options* options, faqem_normals kind) {
    return set_enum(
        options, kind, FAQEM_NORMALS_NONE, [](Options & o) -> auto& { return o.bake.normals; });
}

faqem_status faqem_options_set_image_format(faqem_options* options, faqem_image_format format) {
    return set_enum(
        options, format, FAQEM_IMAGE_SOURCE, [](Options & o) -> auto& { return o.bake.image_format; });
}
