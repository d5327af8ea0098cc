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
