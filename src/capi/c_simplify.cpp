#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "capi/c_mesh.hpp"
#include "capi/c_result.hpp"
#include "capi/guard.hpp"
#include "faqem/simplify.hpp"
#include "faqem/version.hpp"

namespace {

using namespace faqem;

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(uint32_t));

template <class Value>
const Value* data_or_null(const std::vector<Value>& values) {
    return values.empty() ? nullptr : values.data();
}

constexpr double max_faces = 9007199254740992;  // 2^53: doubles represent all integers up to it

Level to_level(const faqem_level& level, std::size_t index) {
    switch (level.kind) {
        case FAQEM_LEVEL_RATIO:
            return ratio(level.value);
        case FAQEM_LEVEL_FACES:
            if (!(level.value >= 1 && level.value <= max_faces && level.value == std::floor(level.value)))
                throw OptionError("level " + std::to_string(index) +
                                  ": the number of faces must be an integer from 1 to 2^53");
            return faces(static_cast<std::uint64_t>(level.value));
        case FAQEM_LEVEL_DISTANCE:
            return model_units(level.value);
        case FAQEM_LEVEL_DISTANCE_OF_DIAGONAL:
            return of_diagonal(level.value);
    }
    throw OptionError("level " + std::to_string(index) + ": unknown kind");
}

}  // namespace

const char* faqem_version(void) {
    return version().data();  // view of a static std::string, which is zero-terminated
}

faqem_status faqem_simplify(const faqem_mesh* mesh, const faqem_options* options, faqem_result** result,
                            faqem_error* error) {
    return capi::catch_exceptions(error, {{mesh, "mesh"}, {result, "result"}}, [&] {
        const capi::MeshArrays arrays(*mesh);
        SimplifyResult made = simplify(arrays.view, capi::options_or_defaults(options));
        capi::warn_of_asset_options(options, made.report);
        *result = new faqem_result(std::move(made));
    });
}

void faqem_result_destroy(faqem_result* result) { delete result; }

size_t faqem_result_vertex_count(const faqem_result* result) {
    return result ? result->out.mesh.positions.size() : 0;
}

size_t faqem_result_face_count(const faqem_result* result) {
    return result ? result->out.mesh.triangles.size() : 0;
}

const double* faqem_result_positions(const faqem_result* result) {
    return faqem_result_vertex_count(result) > 0 ? result->out.mesh.positions.front().data() : nullptr;
}

const uint32_t* faqem_result_triangles(const faqem_result* result) {
    return faqem_result_face_count(result) > 0 ? result->out.mesh.triangles.front().data() : nullptr;
}

const uint32_t* faqem_result_face_groups(const faqem_result* result) {
    return result ? data_or_null(result->out.mesh.face_groups) : nullptr;
}

const float* faqem_result_corner_values(const faqem_result* result) {
    return result ? data_or_null(result->out.mesh.attributes.values) : nullptr;
}

uint32_t faqem_result_corner_width(const faqem_result* result) {
    return result ? result->out.mesh.attributes.width : 0;
}

const uint32_t* faqem_result_vertex_origin(const faqem_result* result) {
    return result ? data_or_null(result->out.vertex_origin) : nullptr;
}

const uint32_t* faqem_result_face_origin(const faqem_result* result) {
    return result ? data_or_null(result->out.face_origin) : nullptr;
}

faqem_status faqem_result_report(const faqem_result* result, faqem_report* report) {
    if (!result || !report) return FAQEM_ERROR_OPTION;
    *report = capi::to_c_report(result->stored_report.report);
    return FAQEM_OK;
}

const char* faqem_result_report_json(const faqem_result* result) {
    return result ? result->stored_report.json.c_str() : nullptr;
}

std::vector<Level> capi::to_levels(const faqem_level* levels, std::size_t count) {
    std::vector<Level> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(to_level(levels[i], i));
    return result;
}

faqem_status faqem_simplify_levels(const faqem_mesh* mesh, const faqem_options* options,
                                   const faqem_level* levels, size_t level_count, faqem_result** results,
                                   faqem_error* error) {
    return capi::catch_exceptions(error, {{mesh, "mesh"}, {levels, "levels"}, {results, "results"}}, [&] {
        const std::vector<Level> wanted = capi::to_levels(levels, level_count);
        const capi::MeshArrays arrays(*mesh);
        std::vector<std::unique_ptr<faqem_result>> objects;
        for (SimplifiedLevel& level :
             simplify_levels(arrays.view, wanted, capi::options_or_defaults(options))) {
            if (objects.empty()) capi::warn_of_asset_options(options, level.result.report);
            objects.push_back(std::make_unique<faqem_result>(std::move(level.result), level.error));
        }
        for (std::size_t i = 0; i < level_count; ++i) results[i] = objects.at(i).release();
    });
}

double faqem_result_level_error(const faqem_result* result) {
    return result ? result->level_error : std::numeric_limits<double>::quiet_NaN();
}
