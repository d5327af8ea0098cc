#ifndef FAQEM_FAQEM_ASSET_H
#define FAQEM_FAQEM_ASSET_H
/**
 * \file
 * C API for textured models: loading, simplification with a new texture, saving. The library has these
 * functions if it was built with FAQEM_BUILD_ASSET, which is the default. faqem/faqem.h describes ownership,
 * errors and threads.
 */

#include "faqem/faqem_levels.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Models ---- */

/** A scene of parts (meshes), materials and images. Only saving modifies it: it may add warnings. */
typedef struct faqem_asset faqem_asset;

/** Whether existing files may be replaced. */
typedef enum faqem_overwrite FAQEM_ENUM { FAQEM_OVERWRITE_NO = 0, FAQEM_OVERWRITE_YES = 1 } faqem_overwrite;

/**
 * Loads a .glb, .gltf, .vrm, .obj, .ply, .stl or .off file.
 * \param path   in the encoding of the file system, usually UTF-8
 * \param asset  receives a new object; repairs and omissions are in its warnings
 * \param error  may be null
 */
FAQEM_API faqem_status faqem_asset_load(const char* path, faqem_asset** asset, faqem_error* error);

/** The bytes of a .glb file. */
typedef struct faqem_glb faqem_glb;

/**
 * Encodes a model as faqem_asset_save() writes it to a .glb file.
 * \param asset  the model; what the format cannot store is added to its warnings
 * \param glb    receives a new object
 * \param error  may be null
 */
FAQEM_API faqem_status faqem_asset_to_glb(faqem_asset* asset, faqem_glb** glb, faqem_error* error);
/** Returns the bytes, which belong to `glb`, and their number in `size`; null and 0 if `glb` is null. */
FAQEM_API const uint8_t* faqem_glb_bytes(const faqem_glb* glb, size_t* size);
FAQEM_API void faqem_glb_destroy(faqem_glb* glb);

/**
 * Reads the bytes of a .glb file, see faqem::from_glb().
 * \param bytes  `size` bytes, read only during the call
 * \param asset  receives a new object; repairs and omissions are in its warnings
 * \param error  may be null
 */
FAQEM_API faqem_status faqem_asset_from_glb(const void* bytes, size_t size, faqem_asset** asset,
                                            faqem_error* error);

/**
 * Creates a model of one part without materials.
 * \param mesh   positions and triangles are copied; locks, weights, groups and corner values are ignored
 * \param asset  receives a new object
 * \param error  may be null
 */
FAQEM_API faqem_status faqem_asset_create(const faqem_mesh* mesh, faqem_asset** asset, faqem_error* error);

/**
 * Simplifies a model and bakes its appearance, see faqem::simplify(const Asset&, ...).
 * \param asset       the model; unchanged
 * \param options     null: the defaults
 * \param simplified  receives a new object, which has a report
 * \param error       may be null
 */
FAQEM_API faqem_status faqem_asset_simplify(const faqem_asset* asset, const faqem_options* options,
                                            faqem_asset** simplified, faqem_error* error);

/**
 * Bakes the appearance of one model onto the mesh of another one, see faqem::bake_onto().
 * \param source        the appearance; unchanged
 * \param target        the mesh; unchanged
 * \param uvs           `auto`, `keep` or `new`; null: `auto`
 * \param max_distance  in scene units, as `0.1`, or as a share of the diagonal of the source, as `2%`; null: `5%`
 * \param options       null: the defaults
 * \param baked         receives a new object, which has a report
 * \param error         may be null
 */
FAQEM_API faqem_status faqem_asset_bake_onto(const faqem_asset* source, const faqem_asset* target,
                                             const char* uvs, const char* max_distance,
                                             const faqem_options* options, faqem_asset** baked,
                                             faqem_error* error);

/** Whether the levels of a model share textures, see faqem::LevelTextures. */
typedef enum faqem_level_textures FAQEM_ENUM {
    FAQEM_LEVEL_TEXTURES_EACH = 0,  /**< every level has its own textures */
    FAQEM_LEVEL_TEXTURES_SHARED = 1 /**< all levels have the textures that are baked for the finest level */
} faqem_level_textures;

/**
 * Simplifies a model to several levels of detail and bakes each, see faqem::simplify_levels(const Asset&,
 * ...).
 * \param asset        the model; unchanged
 * \param options      null: the defaults; ratio, faces, max_error and max_seconds must be unset
 * \param levels       level_count targets, as for faqem_simplify_levels(); distances are in scene units
 * \param level_count  number of levels
 * \param textures     whether the levels share textures
 * \param results      receives level_count new objects, which have reports; none if the call fails
 * \param error        may be null
 */
FAQEM_API faqem_status faqem_asset_simplify_levels(const faqem_asset* asset, const faqem_options* options,
                                                   const faqem_level* levels, size_t level_count,
                                                   faqem_level_textures textures, faqem_asset** results,
                                                   faqem_error* error);

/** As faqem_result_level_error(), in scene units; NaN if the asset is not a level, or null. */
FAQEM_API double faqem_asset_level_error(const faqem_asset* asset);

/**
 * Saves levels of detail as one .glb, .gltf or .vrm file with the extension MSFT_lod, see docs/levels.md.
 * \param levels        level_count models, from fine to coarse, with the same parts; the first one may be the
 *                      original. What the format cannot store is added to the warnings of the first one
 * \param level_count   number of levels, >= 1
 * \param screen_error  maximum size of a level's error on screen, as a share of the screen height, finite and
 *                      > 0: 1.0 / 1080 is one pixel of 1080. It determines the coverage at which each level
 *                      is used
 * \param path          in the encoding of the file system; must end in .glb, .gltf or .vrm
 * \param overwrite     whether existing files may be replaced
 * \param error         may be null
 */
FAQEM_API faqem_status faqem_asset_save_levels(faqem_asset* const* levels, size_t level_count,
                                               double screen_error, const char* path,
                                               faqem_overwrite overwrite, faqem_error* error);

/**
 * Creates the history of a run. Levels with FAQEM_LEVEL_TEXTURES_SHARED have no history.
 * \param levels       all results of one call of faqem_asset_simplify_levels(), in its order, or a single
 *                     result of faqem_asset_simplify(); made with FAQEM_RECORDING_ON, see
 *                     faqem_options_set_history()
 * \param level_count  number of levels, >= 1
 * \param history      receives a new object, which does not refer to the levels
 * \param error        may be null
 */
FAQEM_API faqem_status faqem_asset_history_create(const faqem_asset* const* levels, size_t level_count,
                                                  faqem_history** history, faqem_error* error);

/**
 * Restores a model from a history at a total face count and bakes its appearance, without another run. The
 * face count of a level gives that level; if the last level has more faces, the last level.
 * \param source      the model that was simplified
 * \param history     history of its parts
 * \param faces       maximum number of faces over all parts, >= 1
 * \param options     baking options of the run; null: the defaults. The kind `keep` is rejected
 * \param simplified  receives a new object, which has a report
 * \param error       may be null
 * \return FAQEM_ERROR_INPUT if the history is not that of `source`
 */
FAQEM_API faqem_status faqem_asset_bake_truncated(const faqem_asset* source, const faqem_history* history,
                                                  uint64_t faces, const faqem_options* options,
                                                  faqem_asset** simplified, faqem_error* error);

/**
 * Saves a model as .glb, .gltf, .vrm, .obj, .ply or .stl, by file extension. Each file is complete or absent.
 * \param asset      what the format cannot store is added to its warnings
 * \param path       in the encoding of the file system
 * \param overwrite  whether existing files may be replaced
 * \param error      may be null
 */
FAQEM_API faqem_status faqem_asset_save(faqem_asset* asset, const char* path, faqem_overwrite overwrite,
                                        faqem_error* error);
FAQEM_API void faqem_asset_destroy(faqem_asset* asset);

/* Getters of a model. They return null or 0 if `asset` is null, or if an index is out of range. */

FAQEM_API size_t faqem_asset_part_count(const faqem_asset* asset);
FAQEM_API const char* faqem_asset_part_name(const faqem_asset* asset, size_t part);
FAQEM_API size_t faqem_asset_vertex_count(const faqem_asset* asset, size_t part);
FAQEM_API size_t faqem_asset_face_count(const faqem_asset* asset, size_t part);
/** 3 * vertex_count local coordinates of the part. Vertices are split at seams, as in files. */
FAQEM_API const double* faqem_asset_positions(const faqem_asset* asset, size_t part);
/** 3 * face_count vertex indices. */
FAQEM_API const uint32_t* faqem_asset_triangles(const faqem_asset* asset, size_t part);
/** Number of UV sets of a part. */
FAQEM_API size_t faqem_asset_uv_set_count(const faqem_asset* asset, size_t part);
/** 2 * vertex_count texture coordinates of a set, v pointing down as in glTF. */
FAQEM_API const float* faqem_asset_uvs(const faqem_asset* asset, size_t part, size_t set);
/** face_count materials, see faqem_asset_material_count(); UINT32_MAX: the default material. */
FAQEM_API const uint32_t* faqem_asset_face_materials(const faqem_asset* asset, size_t part);
/** Number of warnings: what was repaired, left out, or could not be saved, one sentence each. */
FAQEM_API size_t faqem_asset_warning_count(const faqem_asset* asset);
FAQEM_API const char* faqem_asset_warning(const faqem_asset* asset, size_t index);
/** Number of kinds of statements that loading ignored because they mean nothing for a model, and of unknown
 * extensions, one line each. */
FAQEM_API size_t faqem_asset_not_understood_count(const faqem_asset* asset);
FAQEM_API const char* faqem_asset_not_understood(const faqem_asset* asset, size_t index);

/** Fills `report`. \return FAQEM_ERROR_OPTION if an argument is null, or the asset is not a simplified one */
FAQEM_API faqem_status faqem_asset_report(const faqem_asset* asset, faqem_report* report);
/** Returns the whole report as JSON (UTF-8); null if the asset is not a simplified one. */
FAQEM_API const char* faqem_asset_report_json(const faqem_asset* asset);

/* ---- Materials and images ---- */

FAQEM_API size_t faqem_asset_material_count(const faqem_asset* asset);
FAQEM_API const char* faqem_asset_material_name(const faqem_asset* asset, size_t material);

/** Uses of an image by a material. */
typedef enum faqem_texture FAQEM_ENUM {
    FAQEM_TEXTURE_BASE_COLOR = 0,
    FAQEM_TEXTURE_METALLIC_ROUGHNESS = 1, /**< roughness in G, metallic in B */
    FAQEM_TEXTURE_NORMAL = 2,
    FAQEM_TEXTURE_OCCLUSION = 3, /**< in R */
    FAQEM_TEXTURE_EMISSIVE = 4
} faqem_texture;

/**
 * Image that a material uses.
 * \param uv_set  receives the UV set of its coordinates; may be null. Unchanged if there is no image
 * \return index of the image; UINT32_MAX if there is none, or if an argument is out of range
 */
FAQEM_API uint32_t faqem_asset_material_image(const faqem_asset* asset, size_t material,
                                              faqem_texture texture, uint32_t* uv_set);

FAQEM_API size_t faqem_asset_image_count(const faqem_asset* asset);
FAQEM_API const char* faqem_asset_image_name(const faqem_asset* asset, size_t image);
/** Media type, for example "image/png"; "" if it is unknown. */
FAQEM_API const char* faqem_asset_image_mime_type(const faqem_asset* asset, size_t image);
/**
 * Content of the image file.
 * \param size  receives the number of bytes; may be null
 */
FAQEM_API const uint8_t* faqem_asset_image_bytes(const faqem_asset* asset, size_t image, size_t* size);

/** Decoded pixels. */
typedef struct faqem_pixels faqem_pixels;

/**
 * Decodes an image: PNG, JPEG, WebP, and what the plugin for images reads (docs/c-api.md).
 * \param image   index below faqem_asset_image_count()
 * \param pixels  receives a new object, which does not refer to the model
 * \param error   may be null
 * \return FAQEM_ERROR_OPTION if `image` is out of range, FAQEM_ERROR_UNSUPPORTED if it is of another kind,
 *         FAQEM_ERROR_INPUT if it is damaged or larger than 16384 x 16384 pixels or 1 GiB
 */
FAQEM_API faqem_status faqem_asset_decode_image(const faqem_asset* asset, size_t image, faqem_pixels** pixels,
                                                faqem_error* error);
FAQEM_API void faqem_pixels_destroy(faqem_pixels* pixels);

/* Getters of pixels. They return null or 0 if `pixels` is null. */

FAQEM_API uint32_t faqem_pixels_width(const faqem_pixels* pixels);
FAQEM_API uint32_t faqem_pixels_height(const faqem_pixels* pixels);
/** 0 if every alpha value is 255, else 1. */
FAQEM_API int32_t faqem_pixels_has_alpha(const faqem_pixels* pixels);
/** 4 * width * height bytes: RGBA, top row first, colours sRGB as in the file. The caller may change them. */
FAQEM_API uint8_t* faqem_pixels_rgba(faqem_pixels* pixels);

#ifdef __cplusplus
}
#endif

#endif
