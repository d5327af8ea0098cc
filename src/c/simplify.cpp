#include "faqem/simplify.hpp"

#include <utility>
#include <vector>

#include "c/guard.hpp"
#include "c/mesh.hpp"
#include "c/objects.hpp"
#include "faqem/version.hpp"

struct faqem_result {
    faqem::TriangleMesh mesh;
    std::vector<faqem::Index> vertex_origin, face_origin;
    faqem::c::KeptReport kept;
};

namespace {

using namespace faqem;

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(uint32_t));

template <class Value>
const Value* data_or_null(const std::vector<Value>& values) {
    return values.empty() ? nullptr : values.data();
}

}  // namespace

const char* faqem_version(void) {
    return version().data();  // of a literal, which ends with zero
}

faqem_status faqem_simplify(const faqem_mesh* mesh, const faqem_options* options, faqem_result** result,
                            faqem_error* error) {
    return c::guarded(error, [&] {
        c::require_argument(mesh, "mesh");
        c::require_argument(result, "result");
        SimplifyResult out = simplify(c::view_of(*mesh), c::options_or_defaults(options));
        if (out.report.stop == StopReason::cancelled) throw c::CancelledError();
        *result = new faqem_result{std::move(out.mesh), std::move(out.vertex_origin),
                                   std::move(out.face_origin), c::KeptReport(out.report)};
    });
}

void faqem_result_destroy(faqem_result* result) { delete result; }

size_t faqem_result_vertex_count(const faqem_result* result) {
    return result ? result->mesh.positions.size() : 0;
}

size_t faqem_result_face_count(const faqem_result* result) {
    return result ? result->mesh.triangles.size() : 0;
}

const double* faqem_result_positions(const faqem_result* result) {
    return faqem_result_vertex_count(result) > 0 ? result->mesh.positions.front().data() : nullptr;
}

const uint32_t* faqem_result_triangles(const faqem_result* result) {
    return faqem_result_face_count(result) > 0 ? result->mesh.triangles.front().data() : nullptr;
}

const uint32_t* faqem_result_face_groups(const faqem_result* result) {
    return result ? data_or_null(result->mesh.face_groups) : nullptr;
}

const uint32_t* faqem_result_vertex_origin(const faqem_result* result) {
    return result ? data_or_null(result->vertex_origin) : nullptr;
}

const uint32_t* faqem_result_face_origin(const faqem_result* result) {
    return result ? data_or_null(result->face_origin) : nullptr;
}

faqem_status faqem_result_report(const faqem_result* result, faqem_report* report) {
    if (!result || !report) return FAQEM_ERROR_OPTION;
    *report = c::numbers_of(result->kept.report);
    return FAQEM_OK;
}

const char* faqem_result_report_json(const faqem_result* result) {
    return result ? result->kept.json.c_str() : nullptr;
}
