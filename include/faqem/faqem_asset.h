#ifndef FAQEM_FAQEM_ASSET_H
#define FAQEM_FAQEM_ASSET_H
/**
 * \file
 * The C door to textured models: load, simplify with a new texture, save. The library has these functions where it
 * was built with FAQEM_BUILD_ASSET, which is the default. faqem/faqem.h says how objects and errors are handled.
 */

#include "faqem/faqem_levels.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Options of the look, see faqem::BakeOptions; setters as in faqem.h ---- */

/** Where the colours go. */
typedef enum faqem_bake FAQEM_ENUM {
    FAQEM_BAKE_AUTOMATIC = 0,
    FAQEM_BAKE_ATLAS = 1,
    FAQEM_BAKE_PER_TRIANGLE = 2,
    FAQEM_BAKE_VERTEX = 3,
    FAQEM_BAKE_KEEP = 4,
    FAQEM_BAKE_NONE = 5
} faqem_bake;

/** Normal map of a new texture. */
typedef enum faqem_normal_map FAQEM_ENUM {
    FAQEM_NORMAL_MAP_AUTOMATIC = 0,
    FAQEM_NORMAL_MAP_ON = 1,
    FAQEM_NORMAL_MAP_OFF = 2
} faqem_normal_map;

/** Vertex normals. */
typedef enum faqem_normals FAQEM_ENUM {
    FAQEM_NORMALS_TRANSFER = 0,
    FAQEM_NORMALS_SMOOTH = 1,
    FAQEM_NORMALS_FLAT = 2,
    FAQEM_NORMALS_NONE = 3
} faqem_normals;

/** How baked images are encoded. */
typedef enum faqem_image_format FAQEM_ENUM {
    FAQEM_IMAGE_PNG = 0,
    FAQEM_IMAGE_JPEG = 1,
    FAQEM_IMAGE_SOURCE = 2
} faqem_image_format;

/** Whether what is hidden from outside counts less, see faqem::Visibility. */
typedef enum faqem_visibility FAQEM_ENUM {
    FAQEM_VISIBILITY_IGNORED = 0,
    FAQEM_VISIBILITY_WEIGHTED = 1
} faqem_visibility;

FAQEM_API faqem_status faqem_options_set_visibility(faqem_options* options, faqem_visibility visibility);
FAQEM_API faqem_status faqem_options_set_bake(faqem_options* options, faqem_bake kind);
/** Largest side of a baked image in texels, a power of two in [64, 16384]. */
FAQEM_API faqem_status faqem_options_set_texture_size(faqem_options* options, uint32_t texels);
/** Texels per length, times those of the source, in [0.125, 8]. Unset: 1, and more on small pages. */
FAQEM_API faqem_status faqem_options_set_texel_density(faqem_options* options, double factor);
FAQEM_API faqem_status faqem_options_set_normal_map(faqem_options* options, faqem_normal_map kind);
FAQEM_API faqem_status faqem_options_set_normals(faqem_options* options, faqem_normals kind);
FAQEM_API faqem_status faqem_options_set_image_format(faqem_options* options, faqem_image_format format);

/* ---- Models ---- */

/** A scene of parts (meshes), materials and images. */
typedef struct faqem_asset faqem_asset;

/** What save may do to a file that exists. */
typedef enum faqem_overwrite FAQEM_ENUM { FAQEM_OVERWRITE_NO = 0, FAQEM_OVERWRITE_YES = 1 } faqem_overwrite;

/**
 * Loads .glb, .gltf, .obj, .ply, .stl or .off.
 * \param path   as the system has it, usually UTF-8
 * \param asset  gets a new object
 */
FAQEM_API faqem_status faqem_asset_load(const char* path, faqem_asset** asset, faqem_error* error);

/**
 * A model of one part without materials, from arrays that are copied. Locks, weights, groups and corner values are not
 * part of a model.
 */
FAQEM_API faqem_status faqem_asset_create(const faqem_mesh* mesh, faqem_asset** asset, faqem_error* error);

/** Simplifies a model and bakes its look anew. \param simplified  gets a new object, which has a report */
FAQEM_API faqem_status faqem_asset_simplify(const faqem_asset* asset, const faqem_options* options,
                                            faqem_asset** simplified, faqem_error* error);

/** Whose images the levels of a model have, see faqem::LevelTextures. */
typedef enum faqem_level_textures FAQEM_ENUM {
    FAQEM_LEVEL_TEXTURES_EACH = 0,  /**< every level its own */
    FAQEM_LEVEL_TEXTURES_SHARED = 1 /**< all those that were baked for the finest level */
} faqem_level_textures;

/**
 * As faqem_simplify_levels(), for a model; distances are in the units of its scene.
 * \param results  gets level_count new objects, which have reports; none where the call fails
 */
FAQEM_API faqem_status faqem_asset_simplify_levels(const faqem_asset* asset, const faqem_options* options,
                                                   const faqem_level* levels, size_t level_count,
                                                   faqem_level_textures textures, faqem_asset** results,
                                                   faqem_error* error);

/** As faqem_result_level_error(), in units of the scene; NaN where the asset is no level. */
FAQEM_API double faqem_asset_level_error(const faqem_asset* asset);

/**
 * Saves levels in one .glb or .gltf with the extension MSFT_lod, see docs/levels.md.
 * \param levels       level_count, from fine to coarse, with the same parts; the first one may be the original. What
 *                     the format could not hold is added to its warnings
 * \param screen_error  of the screen's height that the error of a level may cover, finite and > 0: 1.0 / 1080 is a
 *                     pixel of 1080. How large each level may be seen follows from it
 */
FAQEM_API faqem_status faqem_asset_save_levels(faqem_asset* const* levels, size_t level_count,
                                               double screen_error, const char* path,
                                               faqem_overwrite overwrite, faqem_error* error);

/**
 * The history of a run, made with faqem_options_set_history(); of FAQEM_LEVEL_TEXTURES_SHARED there is none.
 * \param levels   level_count of one faqem_asset_simplify_levels(), in its order; or one of faqem_asset_simplify()
 * \param history  gets a new object; the levels are not needed any more
 */
FAQEM_API faqem_status faqem_asset_history_create(const faqem_asset* const* levels, size_t level_count,
                                                  faqem_history** history, faqem_error* error);

/**
 * The model when no more than `faces` were left, without another run, with a look baked anew. As many as a level has
 * give that level; where even the last level has more, that level.
 * \param source   the model that was simplified
 * \param options  of the look, as the run had them; null: the defaults. FAQEM_BAKE_KEEP is refused
 * \param simplified    gets a new object, which has a report
 */
FAQEM_API faqem_status faqem_asset_bake_truncated(const faqem_asset* source, const faqem_history* history,
                                                  uint64_t faces, const faqem_options* options,
                                                  faqem_asset** simplified, faqem_error* error);

/**
 * Saves as .glb, .gltf, .obj, .ply or .stl, by name. Each file is complete or not there at all.
 * What the format could not hold is added to the warnings of the asset.
 */
FAQEM_API faqem_status faqem_asset_save(faqem_asset* asset, const char* path, faqem_overwrite overwrite,
                                        faqem_error* error);
FAQEM_API void faqem_asset_destroy(faqem_asset* asset);

/** The getters: 0 or null where `asset` is null or an index is out of range. */
FAQEM_API size_t faqem_asset_part_count(const faqem_asset* asset);
FAQEM_API const char* faqem_asset_part_name(const faqem_asset* asset, size_t part);
FAQEM_API size_t faqem_asset_vertex_count(const faqem_asset* asset, size_t part);
FAQEM_API size_t faqem_asset_face_count(const faqem_asset* asset, size_t part);
/** 3 * vertex_count, in the part's own coordinates. Vertices are split at seams, as in the file. */
FAQEM_API const double* faqem_asset_positions(const faqem_asset* asset, size_t part);
/** 3 * face_count. */
FAQEM_API const uint32_t* faqem_asset_triangles(const faqem_asset* asset, size_t part);
/** What was repaired, left out, or could not be saved, one sentence each. */
FAQEM_API size_t faqem_asset_warning_count(const faqem_asset* asset);
FAQEM_API const char* faqem_asset_warning(const faqem_asset* asset, size_t index);

/** \return FAQEM_ERROR_OPTION where an argument is null or the asset was not made by simplifying one */
FAQEM_API faqem_status faqem_asset_report(const faqem_asset* asset, faqem_report* report);
/** null where the asset was not made by simplifying one. */
FAQEM_API const char* faqem_asset_report_json(const faqem_asset* asset);

#ifdef __cplusplus
}
#endif

#endif
