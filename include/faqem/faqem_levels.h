#ifndef FAQEM_FAQEM_LEVELS_H
#define FAQEM_FAQEM_LEVELS_H
/**
 * \file
 * The C door: levels of detail, collapse histories, and the way back to the original. See faqem/faqem.h for how
 * objects, arrays and errors are handled.
 */

#include "faqem/faqem.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Levels of detail ---- */

/** What the value of a level is. */
typedef enum faqem_level_kind FAQEM_ENUM {
    FAQEM_LEVEL_RATIO = 0,    /**< share of the original's faces, in (0, 1] */
    FAQEM_LEVEL_FACES = 1,    /**< number of faces, whole and at least 1 */
    FAQEM_LEVEL_DISTANCE = 2, /**< from the original, model units: the smallest mesh found within it */
    FAQEM_LEVEL_DISTANCE_OF_DIAGONAL = 3 /**< the same, as a share of the bounding box's diagonal */
} faqem_level_kind;

typedef struct faqem_level {
    faqem_level_kind kind;
    double value;
} faqem_level;

/**
 * Simplifies to one level after the other, each from the one before, and measures it against the original.
 * \param levels   level_count, from fine to coarse: counts must not ascend, distances not descend
 * \param options  null: the defaults; ratio, faces and max_error must be unset
 * \param results  gets level_count new objects; none where the call fails
 * For counts one run, and one measurement for each; a distance takes up to 12 runs. See faqem/levels.hpp.
 */
FAQEM_API faqem_status faqem_simplify_levels(const faqem_mesh* mesh, const faqem_options* options,
                                             const faqem_level* levels, size_t level_count,
                                             faqem_result** results, faqem_error* error);

/**
 * Of a level: no point of it or of the original is farther from the other, model units; a coarser level's is not
 * smaller. Infinity where nothing is left, NaN where the result is not of faqem_simplify_levels().
 */
FAQEM_API double faqem_result_level_error(const faqem_result* result);

/* ---- Histories ---- */

/** How the original became one level after the other. Nothing in it changes. */
typedef struct faqem_history faqem_history;

/**
 * The history of a run, made with faqem_options_set_history().
 * \param results  result_count of one faqem_simplify_levels(), in its order; or one of faqem_simplify()
 * \param history  gets a new object; the results are not needed any more
 */
FAQEM_API faqem_status faqem_history_create(const faqem_result* const* results, size_t result_count,
                                            faqem_history** history, faqem_error* error);
/** From the bytes of faqem_history_bytes(), or of a file that the command wrote. */
FAQEM_API faqem_status faqem_history_read(const uint8_t* bytes, size_t size, faqem_history** history,
                                          faqem_error* error);
FAQEM_API void faqem_history_destroy(faqem_history* history);

/** In the format of docs/history-format.md. \param size  gets their number */
FAQEM_API const uint8_t* faqem_history_bytes(const faqem_history* history, size_t* size);
/** Meshes that it is of: 1, or the parts of a model. 0 where `history` is null. */
FAQEM_API size_t faqem_history_part_count(const faqem_history* history);
/** 0 where `history` is null. */
FAQEM_API size_t faqem_history_level_count(const faqem_history* history);

/**
 * The mesh when no more than `faces` were left, without another run; as many as a level has give that level. Where
 * even the last level has more, that level. See truncate_to_faces() in faqem/truncate.hpp.
 * \param result  gets a new object, without what is not in a history: corner values and vertex origins
 * \return FAQEM_ERROR_OPTION also where the history is of several meshes
 */
FAQEM_API faqem_status faqem_history_truncate(const faqem_history* history, uint64_t faces,
                                              faqem_result** result, faqem_error* error);
/**
 * The same for all meshes of a history together; `faces` counts for all. With a new look: faqem_asset_bake_truncated().
 * \param results  gets faqem_history_part_count() new objects, in the order of the parts; none where the call fails
 */
FAQEM_API faqem_status faqem_history_truncate_parts(const faqem_history* history, uint64_t faces,
                                                    faqem_result** results, faqem_error* error);

/* ---- The way back ---- */

/** How a point of the small mesh finds its place on the original, see docs/baking.md. */
typedef enum faqem_mapping FAQEM_ENUM {
    FAQEM_MAPPING_PROJECTION = 0,
    FAQEM_MAPPING_LINEAGE = 1,
    FAQEM_MAPPING_CLOSEST = 2
} faqem_mapping;

/**
 * Where points of a small mesh lie on the original, by the history: for fields, labels and weights of one's own.
 * \param result              made with faqem_options_set_history(), or cut from a history
 * \param faces               count faces of the small mesh
 * \param barycentric         3 * count weights of their corners, >= 0, of sum 1
 * \param source_faces        gets count faces of the original
 * \param source_barycentric  gets 3 * count weights of their corners
 * O(n log n) in the original's faces for each call, then O(log n) typically for each point: ask for many at once.
 */
FAQEM_API faqem_status faqem_result_map(const faqem_result* result, faqem_mapping mapping,
                                        const uint32_t* faces, const double* barycentric, size_t count,
                                        uint32_t* source_faces, double* source_barycentric,
                                        faqem_error* error);

#ifdef __cplusplus
}
#endif

#endif
