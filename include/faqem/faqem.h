#ifndef FAQEM_FAQEM_H
#define FAQEM_FAQEM_H
/**
 * \file
 * The C door: flat arrays in, flat arrays out, for other languages. C11 and C++.
 *
 * Objects are made by faqem_..._create() or by a function that fills a `**` argument, and end with
 * faqem_..._destroy(), which takes null too. One object may be read by several threads at a time; to change it,
 * it must belong to one. There is no global state.
 *
 * What can fail returns a faqem_status and fills the faqem_error it is given, which may be null. Then nothing is
 * written to the other arguments. Arrays and strings that are returned belong to the object they were asked of.
 * Levels of detail and histories are in faqem/faqem_levels.h, textured models in faqem/faqem_asset.h.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define FAQEM_ENUM : int32_t /* a number that is no enumerator is an error, not undefined */
extern "C" {
#else
#define FAQEM_ENUM
#endif

#define FAQEM_API __attribute__((visibility("default")))

/** How a call ended. The numbers are the exit codes of the faqem command. */
typedef enum faqem_status FAQEM_ENUM {
    FAQEM_OK = 0,
    FAQEM_ERROR_INTERNAL = 1,
    FAQEM_ERROR_OPTION = 2,      /**< an option is out of range, or an argument is null that must not be */
    FAQEM_ERROR_INPUT = 3,       /**< the data is wrong, or a file could not be read */
    FAQEM_ERROR_UNSUPPORTED = 4, /**< valid, but of a kind that this build cannot handle */
    FAQEM_ERROR_WRITE = 7,       /**< a file could not be written */
    FAQEM_ERROR_CANCELLED = 8,   /**< the progress callback said so */
    FAQEM_ERROR_NO_MEMORY = 11
} faqem_status;

/** What went wrong. Belongs to the caller; need not be initialised. */
typedef struct faqem_error {
    faqem_status status;
    char message[2044]; /**< one sentence in UTF-8, ended by zero; " ..." at its end where it did not fit */
} faqem_error;

/** Version of the library, "MAJOR.MINOR.PATCH". */
FAQEM_API const char* faqem_version(void);

/* ---- Options ---- */

/** What is wanted. New options have the defaults of faqem::Options: preset balanced, a tenth of the faces. */
typedef struct faqem_options faqem_options;

/** \return null where there is no memory */
FAQEM_API faqem_options* faqem_options_create(void);
FAQEM_API void faqem_options_destroy(faqem_options* options);

/** Metric and rules, as in faqem/options.hpp. */
typedef enum faqem_preset FAQEM_ENUM {
    FAQEM_PRESET_QEM = 0,
    FAQEM_PRESET_PAPER = 1,
    FAQEM_PRESET_STMW = 2,
    FAQEM_PRESET_FAST = 3,
    FAQEM_PRESET_BALANCED = 4,
    FAQEM_PRESET_BEST = 5
} faqem_preset;

/** Unit of a length. */
typedef enum faqem_unit FAQEM_ENUM {
    FAQEM_UNIT_MODEL = 0,   /**< that of the positions */
    FAQEM_UNIT_DIAGONAL = 1 /**< the bounding box's diagonal: 0.001 is a thousandth of it */
} faqem_unit;

/** When the topology is kept, see faqem::LinkCondition. */
typedef enum faqem_link FAQEM_ENUM {
    FAQEM_LINK_AS_PRESET = 0,
    FAQEM_LINK_OFF = 1,
    FAQEM_LINK_BY_SIZE = 2,
    FAQEM_LINK_ON = 3,
    FAQEM_LINK_STRICT = 4
} faqem_link;

/** Whether a boundary may move. */
typedef enum faqem_boundary FAQEM_ENUM { FAQEM_BOUNDARY_FREE = 0, FAQEM_BOUNDARY_KEPT = 1 } faqem_boundary;

/** Whether something that takes memory is kept. */
typedef enum faqem_recording FAQEM_ENUM { FAQEM_RECORDING_OFF = 0, FAQEM_RECORDING_ON = 1 } faqem_recording;

/**
 * The setters. Each returns FAQEM_OK, or FAQEM_ERROR_OPTION where `options` is null or an enumerator unknown, and
 * then changes nothing. Ranges are checked by the call that gets the options.
 */
/** Share of the faces to keep, in (0, 1]. Replaces a count. */
FAQEM_API faqem_status faqem_options_set_ratio(faqem_options* options, double ratio);
/** Faces to keep, 1 or more; a result has at most max(4, faces). Replaces a share. */
FAQEM_API faqem_status faqem_options_set_faces(faqem_options* options, uint64_t faces);
/** Largest distance from the original, finite and > 0. Without ratio and faces: the smallest mesh within it. */
FAQEM_API faqem_status faqem_options_set_max_error(faqem_options* options, double distance, faqem_unit unit);
FAQEM_API faqem_status faqem_options_set_preset(faqem_options* options, faqem_preset preset);
FAQEM_API faqem_status faqem_options_set_link(faqem_options* options, faqem_link link);
/** Open borders. */
FAQEM_API faqem_status faqem_options_set_boundary(faqem_options* options, faqem_boundary boundary);
/** Curves between faces of different groups (of a model: materials). */
FAQEM_API faqem_status faqem_options_set_group_boundaries(faqem_options* options, faqem_boundary boundary);
/** Vertices at most this far apart become one, model units, >= 0. */
FAQEM_API faqem_status faqem_options_set_weld_distance(faqem_options* options, double distance);
/** Open borders of parts that do not touch are joined over gaps up to this share of the diagonal, in (0, 1]. */
FAQEM_API faqem_status faqem_options_set_virtual_edges(faqem_options* options, double share);
/** Connected components whose box has a smaller diagonal are deleted first; finite and > 0. */
FAQEM_API faqem_status faqem_options_set_prune(faqem_options* options, double size, faqem_unit unit);
/** Whether results keep the collapse history, for faqem/faqem_levels.h. */
FAQEM_API faqem_status faqem_options_set_history(faqem_options* options, faqem_recording history);
/** Threads at most; 0: all there are. The result does not depend on it. */
FAQEM_API faqem_status faqem_options_set_threads(faqem_options* options, uint32_t threads);

/** The phases of the work, in order. */
typedef enum faqem_phase FAQEM_ENUM {
    FAQEM_PHASE_LOAD = 0,
    FAQEM_PHASE_WELD = 1,
    FAQEM_PHASE_SIMPLIFY = 2,
    FAQEM_PHASE_MAP = 3,
    FAQEM_PHASE_BAKE = 4,
    FAQEM_PHASE_SAVE = 5
} faqem_phase;

/** Called now and then on the calling thread. `fraction` of the phase is done. \return nonzero to cancel */
typedef int (*faqem_progress)(void* user, faqem_phase phase, double fraction);

/** `progress` may be null. `user` is handed to it and has to live as long as the options. */
FAQEM_API faqem_status faqem_options_set_progress(faqem_options* options, faqem_progress progress,
                                                  void* user);

/* ---- Arrays ---- */

/** A triangle soup that belongs to the caller and is only read. Zero it, then fill what there is. */
typedef struct faqem_mesh {
    const float* positions;         /**< 3 * vertex_count, finite; or null, and double_positions is given */
    const double* double_positions; /**< 3 * vertex_count, finite; or null */
    size_t vertex_count;
    /** 3 * face_count vertices, counter-clockwise seen from outside; or null, and short_triangles is given. */
    const uint32_t* triangles;
    const uint16_t* short_triangles; /**< the same in 16 bits; or null */
    size_t face_count;
    const uint32_t* face_groups; /**< null, or face_count groups (materials) */
    const uint8_t* vertex_locks; /**< null, or vertex_count; nonzero: stays where it is */
    const float*
        vertex_weights; /**< null, or vertex_count in [1e-6, 1e6]: errors there count so many times */
    /** Null, or corner_width numbers for each of the 3 * face_count corners, such as UVs: they are carried along. */
    const float* corner_values;
    uint32_t corner_width;
    /**
     * Bytes from a vertex or face to the next one, and from x to y to z, or from corner to corner; 0: side by side.
     * sizeof(struct vertex) is the stride of positions among other data; of a matrix that lies column by column the
     * stride is sizeof(float), and the step sizeof(float) * vertex_count.
     */
    size_t position_stride, position_step, triangle_stride, triangle_step;
} faqem_mesh;

/** A small mesh, where it came from, and the report. Nothing in it changes. */
typedef struct faqem_result faqem_result;

/**
 * Simplifies a mesh.
 * \param mesh     any triangle soup; no faces give an empty result
 * \param options  null: the defaults
 * \param result   gets a new object
 * \param error    may be null
 * O(n log n) time in the faces, O(n) memory; see faqem/simplify.hpp.
 */
FAQEM_API faqem_status faqem_simplify(const faqem_mesh* mesh, const faqem_options* options,
                                      faqem_result** result, faqem_error* error);
FAQEM_API void faqem_result_destroy(faqem_result* result);

/** The getters of a result: null where there is nothing, or where `result` is null. */
FAQEM_API size_t faqem_result_vertex_count(const faqem_result* result);
FAQEM_API size_t faqem_result_face_count(const faqem_result* result);
/** 3 * vertex_count. A vertex that was not moved has its position to the last bit. */
FAQEM_API const double* faqem_result_positions(const faqem_result* result);
/** 3 * face_count. */
FAQEM_API const uint32_t* faqem_result_triangles(const faqem_result* result);
/** face_count, or null where the input had no groups. */
FAQEM_API const uint32_t* faqem_result_face_groups(const faqem_result* result);
/** corner_width * 3 * face_count, or null where the input had none. */
FAQEM_API const float* faqem_result_corner_values(const faqem_result* result);
/** As that of the input; 0 where it had none. */
FAQEM_API uint32_t faqem_result_corner_width(const faqem_result* result);
/** vertex_count: an input vertex that each grew from. */
FAQEM_API const uint32_t* faqem_result_vertex_origin(const faqem_result* result);
/** face_count: the input face that each was. */
FAQEM_API const uint32_t* faqem_result_face_origin(const faqem_result* result);

/* ---- Reports ---- */

/** Why the collapses ended. */
typedef enum faqem_stop FAQEM_ENUM {
    FAQEM_STOP_REACHED_TARGET = 0,
    FAQEM_STOP_NO_LEGAL_COLLAPSE = 1,
    FAQEM_STOP_REACHED_MAX_ERROR = 2
} faqem_stop;

/** The numbers that are asked for most; the JSON report has all. */
typedef struct faqem_report {
    uint64_t vertices_in, vertices_out, faces_in, faces_out;
    uint64_t target_faces;
    double error_value; /**< measured distance where a max_error was set, else NaN */
    double error_bound; /**< that no point exceeds, else NaN */
    double seconds;     /**< wall clock, all phases */
    faqem_stop stop;
    int32_t within_max_error; /**< 1 or 0; 1 where none was set */
} faqem_report;

/** \return FAQEM_ERROR_OPTION where an argument is null */
FAQEM_API faqem_status faqem_result_report(const faqem_result* result, faqem_report* report);
/** Everything that happened, with the keys of docs/cli.md. UTF-8. */
FAQEM_API const char* faqem_result_report_json(const faqem_result* result);

#ifdef __cplusplus
}
#endif

#endif
