#ifndef FAQEM_FAQEM_LEVELS_H
#define FAQEM_FAQEM_LEVELS_H
/**
 * \file
 * C API for levels of detail, collapse histories, and the map to the original. faqem/faqem.h describes
 * ownership, errors and threads.
 */

#include "faqem/faqem.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Levels of detail ---- */

/** Meaning of faqem_level.value. */
typedef enum faqem_level_kind FAQEM_ENUM {
    FAQEM_LEVEL_RATIO = 0,    /**< share of the original's faces, in (0, 1] */
    FAQEM_LEVEL_FACES = 1,    /**< number of faces, an integer from 1 to 2^53 */
    FAQEM_LEVEL_DISTANCE = 2, /**< maximum distance from the original, model units, finite and > 0 */
    FAQEM_LEVEL_DISTANCE_OF_DIAGONAL = 3 /**< the same, as a share of the bounding-box diagonal */
} faqem_level_kind;

/** Target of one level. For a distance the level is the smallest mesh found within it. */
typedef struct faqem_level {
    faqem_level_kind kind;
    double value;
} faqem_level;

/**
 * Simplifies a mesh to several levels of detail, see faqem::simplify_levels(). Each level continues from the
 * previous one and is measured against the original.
 * \param mesh         any triangle soup
 * \param options      null: the defaults; ratio, faces, max_error and max_seconds must be unset
 * \param levels       level_count targets, from fine to coarse: face counts must not increase, distances must
 *                     not decrease
 * \param level_count  number of levels
 * \param results      receives level_count new objects; none if the call fails
 * \param error        may be null
 * Complexity: for face counts one run, and one measurement per level; each distance takes up to 12 more runs.
 */
FAQEM_API faqem_status faqem_simplify_levels(const faqem_mesh* mesh, const faqem_options* options,
                                             const faqem_level* levels, size_t level_count,
                                             faqem_result** results, faqem_error* error);

/**
 * Returns the upper bound of the two-sided Hausdorff distance between a level and the original, model units.
 * It is never smaller than that of a finer level. Infinity if no face is left; NaN if the result is not one
 * of faqem_simplify_levels(), or null.
 */
FAQEM_API double faqem_result_level_error(const faqem_result* result);

/* ---- Histories ---- */

/** Collapse history of a chain of levels, for one mesh or for all parts of a model. Immutable. */
typedef struct faqem_history faqem_history;

/**
 * Creates the history of a run.
 * \param results       all results of one call of faqem_simplify_levels(), in its order, or a single result
 *                      of faqem_simplify(); made with FAQEM_RECORDING_ON, see faqem_options_set_history()
 * \param result_count  number of results, >= 1
 * \param history       receives a new object, which does not refer to the results
 * \param error         may be null
 */
FAQEM_API faqem_status faqem_history_create(const faqem_result* const* results, size_t result_count,
                                            faqem_history** history, faqem_error* error);
/**
 * Creates a history from its serialised form.
 * \param bytes    from faqem_history_bytes(), or the content of a history file of the command
 * \param size     number of bytes
 * \param history  receives a new object, which does not refer to the bytes
 * \param error    may be null
 */
FAQEM_API faqem_status faqem_history_read(const uint8_t* bytes, size_t size, faqem_history** history,
                                          faqem_error* error);
FAQEM_API void faqem_history_destroy(faqem_history* history);

/**
 * Returns the history serialised in the format of docs/history-format.md; null if `history` is null.
 * \param size  receives the number of bytes; may be null
 */
FAQEM_API const uint8_t* faqem_history_bytes(const faqem_history* history, size_t* size);
/** Returns the number of meshes: 1, or the number of parts of a model. 0 if `history` is null. */
FAQEM_API size_t faqem_history_part_count(const faqem_history* history);
/** Returns the number of levels. 0 if `history` is null. */
FAQEM_API size_t faqem_history_level_count(const faqem_history* history);

/**
 * Restores the mesh at the first time when at most `faces` faces were left, without another run. The face
 * count of a level gives that level; if the last level has more faces, the last level. See
 * faqem::truncate_to_faces().
 * \param history  history of one mesh
 * \param faces    maximum number of faces, >= 1
 * \param result   receives a new object, without corner values and vertex origins, which no history has
 * \param error    may be null
 * \return FAQEM_ERROR_OPTION also if the history is of several meshes
 * Complexity: O(size of the history).
 */
FAQEM_API faqem_status faqem_history_truncate(const faqem_history* history, uint64_t faces,
                                              faqem_result** result, faqem_error* error);
/**
 * Restores all meshes of a history at a total face count. To restore the appearance too, use
 * faqem_asset_bake_truncated().
 * \param history  history of one or several meshes
 * \param faces    maximum number of faces over all meshes, >= 1
 * \param results  receives faqem_history_part_count() new objects, in the order of the parts; none if the
 *                 call fails
 * \param error    may be null
 * Complexity: O(size of the history).
 */
FAQEM_API faqem_status faqem_history_truncate_parts(const faqem_history* history, uint64_t faces,
                                                    faqem_result** results, faqem_error* error);

/* ---- Map to the original ---- */

/**
 * Maps points of a simplified mesh to the original by the collapse history (docs/baking.md), to transfer
 * fields, labels or weights.
 * \param result              made with FAQEM_RECORDING_ON, or restored from a history
 * \param faces               count faces of the simplified mesh
 * \param barycentric         3 * count weights of the corners, >= 0, sum 1 (to 1e-6)
 * \param count               number of points
 * \param source_faces        receives count faces of the original
 * \param source_barycentric  receives 3 * count weights of the corners
 * \param error               may be null
 * Complexity: O(n log n) per call in the number of original faces, plus typically O(log n) per point: map
 * many points in one call.
 */
FAQEM_API faqem_status faqem_result_map(const faqem_result* result, const uint32_t* faces,
                                        const double* barycentric, size_t count, uint32_t* source_faces,
                                        double* source_barycentric, faqem_error* error);

#ifdef __cplusplus
}
#endif

#endif
