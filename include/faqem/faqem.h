#ifndef FAQEM_FAQEM_H
#define FAQEM_FAQEM_H
/**
 * \file
 * C API for flat arrays, valid C11 and C++. Levels of detail and histories are in faqem/faqem_levels.h,
 * textured models in faqem/faqem_asset.h.
 *
 * Ownership: an object is created by faqem_..._create() or by a function with a `**` parameter, and belongs
 * to the caller, who destroys it with the faqem_..._destroy() of its type, which accepts null. Arrays and
 * strings that a getter returns belong to the object and are valid as long as it exists.
 *
 * Errors: functions that can fail return a faqem_status and fill the faqem_error that the caller passes,
 * which may be null. After an error no other output parameter has been written. No C++ exception leaves the
 * library.
 *
 * Threads: several threads may read an object concurrently; a thread that modifies it needs exclusive access.
 * Saving a model counts as reading. There is no global state.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define FAQEM_ENUM : int32_t /* fixed type: a value without an enumerator is an error, not undefined */
extern "C" {
#else
#define FAQEM_ENUM
#endif

#ifndef _WIN32
#define FAQEM_API __attribute__((visibility("default")))
#elif defined(FAQEM_EXPORTS)
#define FAQEM_API __declspec(dllexport)
#else
#define FAQEM_API
#endif

/** Outcome of a call. The values are the exit codes of the faqem command. */
typedef enum faqem_status FAQEM_ENUM {
    FAQEM_OK = 0,
    FAQEM_ERROR_INTERNAL = 1,
    FAQEM_ERROR_OPTION = 2,      /**< an option is out of range, or a required argument is null */
    FAQEM_ERROR_INPUT = 3,       /**< the input is invalid, or a file could not be read */
    FAQEM_ERROR_UNSUPPORTED = 4, /**< the input is valid, but of a kind that this build does not support */
    FAQEM_ERROR_WRITE = 7,       /**< a file could not be written */
    FAQEM_ERROR_CANCELLED = 8,   /**< the progress callback returned nonzero */
    FAQEM_ERROR_BYTE_LIMIT = 10, /**< no result has at most "max-bytes" */
    FAQEM_ERROR_NO_MEMORY = 11,
    FAQEM_ERROR_TIME_LIMIT =
        12 /**< "max-seconds" was over before there was a result that the options allow */
} faqem_status;

/** Status and message of a call. Belongs to the caller; need not be initialised. */
typedef struct faqem_error {
    faqem_status status;
    char message[2044]; /**< UTF-8, zero-terminated; ends with " ..." if it was too long */
} faqem_error;

/** Returns the version of the library, "MAJOR.MINOR.PATCH". */
FAQEM_API const char* faqem_version(void);

/* ---- Options ---- */

/** Options of a run. New ones have the defaults of faqem::Options: preset balanced, a tenth of the faces. */
typedef struct faqem_options faqem_options;

/** Creates options. \return null if out of memory */
FAQEM_API faqem_options* faqem_options_create(void);
FAQEM_API void faqem_options_destroy(faqem_options* options);

/** Metric and legality rules, see faqem::Preset. */
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
    FAQEM_UNIT_MODEL = 0,   /**< model units; for a model file, scene units */
    FAQEM_UNIT_DIAGONAL = 1 /**< diagonal of the original's bounding box: 0.001 is a thousandth of it */
} faqem_unit;

/** Whether optional data is recorded. */
typedef enum faqem_recording FAQEM_ENUM { FAQEM_RECORDING_OFF = 0, FAQEM_RECORDING_ON = 1 } faqem_recording;

/**
 * Sets any option from text, for example "texel-density" to "1.5". docs/c-api.md lists the options.
 * \param name   as faqem_option_name() returns it
 * \param value  a number, a length (`0.01` in model units, `0.1%` of the diagonal) or a word, as in the command
 * \param error  its message names the option, and suggests one if there is none with this name; may be null
 * \return FAQEM_ERROR_OPTION if an argument is null, the option does not exist, or the value is not of its kind
 *         or out of its range; the options are then unchanged
 */
FAQEM_API faqem_status faqem_options_set(faqem_options* options, const char* name, const char* value,
                                         faqem_error* error);
/** Number of options that faqem_options_set() accepts. */
FAQEM_API size_t faqem_option_count(void);
/** Name of an option. \return null if `index` is not below faqem_option_count() */
FAQEM_API const char* faqem_option_name(size_t index);
/** Choices, meaning, range and default of an option, with names as in the command. The text is never freed.
 * \return null if `index` is not below faqem_option_count() */
FAQEM_API const char* faqem_option_help(size_t index);

/*
 * Typed setters of frequent options. Each returns FAQEM_OK, or FAQEM_ERROR_OPTION if `options` is null or an
 * enumerator is unknown; the options are then unchanged. The call that uses the options checks the ranges.
 */
/** Target as a share of the input's faces, in (0, 1]. Replaces a target face count. */
FAQEM_API faqem_status faqem_options_set_ratio(faqem_options* options, double ratio);
/** Target face count, >= 1; a result has at most max(4, faces) faces. Replaces a ratio. */
FAQEM_API faqem_status faqem_options_set_faces(faqem_options* options, uint64_t faces);
/**
 * Maximum two-sided Hausdorff distance from the original, finite and > 0. Without ratio and faces, the result
 * is the smallest mesh found within it; otherwise the distance of the result is measured, see faqem_report.
 */
FAQEM_API faqem_status faqem_options_set_max_error(faqem_options* options, double distance, faqem_unit unit);
FAQEM_API faqem_status faqem_options_set_preset(faqem_options* options, faqem_preset preset);
/** Whether results have a collapse history, which functions in faqem/faqem_levels.h need. */
FAQEM_API faqem_status faqem_options_set_history(faqem_options* options, faqem_recording history);

/** Phases of a run, in order. */
typedef enum faqem_phase FAQEM_ENUM {
    FAQEM_PHASE_LOAD = 0,
    FAQEM_PHASE_WELD = 1,
    FAQEM_PHASE_SIMPLIFY = 2,
    FAQEM_PHASE_MAP = 3,
    FAQEM_PHASE_BAKE = 4,
    FAQEM_PHASE_SAVE = 5
} faqem_phase;

/**
 * Progress callback, called at intervals on the thread that called faqem.
 * \param user      pointer passed to faqem_options_set_progress()
 * \param phase     current phase
 * \param fraction  completed share of the phase, in [0, 1]
 * \return nonzero to cancel the run
 */
typedef int (*faqem_progress)(void* user, faqem_phase phase, double fraction);

/**
 * Sets the progress callback.
 * \param progress  null: none
 * \param user      passed to the callback; must be valid as long as the options are used
 */
FAQEM_API faqem_status faqem_options_set_progress(faqem_options* options, faqem_progress progress,
                                                  void* user);

/* ---- Arrays ---- */

/**
 * View of the caller's triangle soup, which is only read during a call. Initialise it with zeros, then set
 * the arrays that exist.
 */
typedef struct faqem_mesh {
    const float* positions;         /**< 3 * vertex_count, model units, finite; null: see double_positions */
    const double* double_positions; /**< the same as double; set one of both */
    size_t vertex_count;            /**< at most 2^32 - 2 */
    /** 3 * face_count vertex indices, counter-clockwise as seen from outside; null: see short_triangles. */
    const uint32_t* triangles;
    const uint16_t* short_triangles; /**< the same with 16 bits; set one of both */
    size_t face_count;               /**< at most 715,827,880 */
    const uint32_t* face_groups;     /**< null, or face_count groups (materials) */
    const uint8_t* vertex_locks;     /**< null, or vertex_count flags; nonzero: the vertex must not move */
    const float* vertex_weights;     /**< null, or vertex_count factors on the costs, in [1e-6, 1e6] */
    /** Null, or 3 * face_count * corner_width finite attributes of the face corners, e.g. UVs; preserved. */
    const float* corner_values;
    uint32_t corner_width; /**< number of attributes per corner; 0 if corner_values is null */
    /**
     * Layout in bytes: from one vertex or face to the next (stride), and from x to y and y to z, or from one
     * corner to the next (step). 0: contiguous. For positions in an array of structs the stride is the size
     * of the struct. For a column-major matrix of floats with one row per vertex the stride is sizeof(float),
     * and the step sizeof(float) * vertex_count. Any layout is valid in which no two numbers share a byte;
     * others are FAQEM_ERROR_INPUT. For contiguous floats, strides of 1 to 11 are therefore an error.
     */
    size_t position_stride, position_step, triangle_stride, triangle_step;
} faqem_mesh;

/** Result of a simplification: the mesh, the origin of its elements, and the report. Immutable. */
typedef struct faqem_result faqem_result;

/**
 * Simplifies a mesh, see faqem::simplify().
 * \param mesh     any triangle soup; without faces the result is empty
 * \param options  null: the defaults
 * \param result   receives a new object
 * \param error    may be null
 * Complexity: O(n log n) time and O(n) memory in the number n of faces, for bounded valence.
 */
FAQEM_API faqem_status faqem_simplify(const faqem_mesh* mesh, const faqem_options* options,
                                      faqem_result** result, faqem_error* error);
FAQEM_API void faqem_result_destroy(faqem_result* result);

/* Getters of a result. They return null or 0 if `result` is null, or if the array is empty. */

FAQEM_API size_t faqem_result_vertex_count(const faqem_result* result);
FAQEM_API size_t faqem_result_face_count(const faqem_result* result);
/** 3 * vertex_count coordinates, model units. An unmoved vertex has its input position, bit by bit. */
FAQEM_API const double* faqem_result_positions(const faqem_result* result);
/** 3 * face_count vertex indices. */
FAQEM_API const uint32_t* faqem_result_triangles(const faqem_result* result);
/** face_count groups; null if the input has no groups. */
FAQEM_API const uint32_t* faqem_result_face_groups(const faqem_result* result);
/** 3 * face_count * corner_width attributes; null if the input has no corner values. */
FAQEM_API const float* faqem_result_corner_values(const faqem_result* result);
/** corner_width of the input; 0 if it has no corner values. */
FAQEM_API uint32_t faqem_result_corner_width(const faqem_result* result);
/** vertex_count source vertices: for each vertex, an input vertex that was collapsed into it. */
FAQEM_API const uint32_t* faqem_result_vertex_origin(const faqem_result* result);
/** face_count source faces: the input face of each face. */
FAQEM_API const uint32_t* faqem_result_face_origin(const faqem_result* result);

/* ---- Reports ---- */

/** Why the collapse loop ended, see faqem::StopReason. */
typedef enum faqem_stop FAQEM_ENUM {
    FAQEM_STOP_REACHED_TARGET = 0,
    FAQEM_STOP_NO_LEGAL_COLLAPSE = 1,
    FAQEM_STOP_REACHED_MAX_ERROR = 2,
    FAQEM_STOP_REACHED_TIME_LIMIT = 4
} faqem_stop;

/** The most important fields of a report; the JSON report has all of them. */
typedef struct faqem_report {
    uint64_t vertices_in, vertices_out, faces_in, faces_out;
    uint64_t target_faces;
    double error_value; /**< lower bound of the distance from the original; NaN if max_error is unset */
    double error_bound; /**< upper bound of the distance from the original; NaN if max_error is unset */
    double seconds;     /**< wall-clock time of all phases */
    faqem_stop stop;
    int32_t within_max_error; /**< 1 if error_bound is at most max_error, or if that is unset; else 0 */
} faqem_report;

/** Fills `report`. \return FAQEM_ERROR_OPTION if an argument is null */
FAQEM_API faqem_status faqem_result_report(const faqem_result* result, faqem_report* report);
/** Returns the whole report as JSON (UTF-8), with the keys documented in docs/reference.md. */
FAQEM_API const char* faqem_result_report_json(const faqem_result* result);

#ifdef __cplusplus
}
#endif

#endif
