#include "capi/c_history.hpp"

#include <memory>
#include <sstream>
#include <utility>

#include "capi/c_result.hpp"
#include "capi/guard.hpp"
#include "faqem/surface_map.hpp"

namespace {

using namespace faqem;

const CollapseHistory& history_of(const faqem_result* result) {
    capi::require_argument(result, "result");
    if (result->out.history.empty())
        throw OptionError(
            "the result has no history: set the option history (results without faces have none)");
    return result->out.history;
}

void check_point(const CollapseHistory& history, Index face, const Vec3& weights, std::size_t i) {
    const std::string where = "point " + std::to_string(i);
    if (face >= history.remaining_faces.size())
        throw InputError("", where, "face index is out of range: " + std::to_string(face));
    const double sum = weights[0] + weights[1] + weights[2];
    if (!(weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0 && sum > 1 - 1e-6 && sum < 1 + 1e-6))
        throw InputError("", where, "barycentric weights must be >= 0 and sum to 1");
}

}  // namespace

faqem_history::faqem_history(std::vector<ChainHistory> histories) : parts(std::move(histories)) {
    std::ostringstream out;
    for (const ChainHistory& part : parts) write(part, out);
    bytes = std::move(out).str();
}

std::vector<CollapseHistory> capi::truncate_parts(const faqem_history* history, std::uint64_t faces) {
    capi::require_argument(history, "history");
    if (faces == 0) throw OptionError("faces must be >= 1");
    return truncate_to_faces(history->parts, faces);
}

faqem_status faqem_history_create(const faqem_result* const* results, size_t result_count,
                                  faqem_history** history, faqem_error* error) {
    return capi::catch_exceptions(error, {{results, "results"}, {history, "history"}}, [&] {
        if (result_count == 0) throw OptionError("results: at least one is required");
        std::vector<CollapseHistory> levels;
        for (std::size_t i = 0; i < result_count; ++i) levels.push_back(history_of(results[i]));
        *history = new faqem_history(std::vector<ChainHistory>{join(levels)});
    });
}

faqem_status faqem_history_read(const uint8_t* bytes, size_t size, faqem_history** history,
                                faqem_error* error) {
    return capi::catch_exceptions(error, {{bytes, "bytes"}, {history, "history"}}, [&] {
        std::istringstream in(std::string(reinterpret_cast<const char*>(bytes), size));
        std::vector<ChainHistory> parts;
        do parts.push_back(read_chain_history(in));
        while (in.peek() != std::istringstream::traits_type::eof());
        *history = new faqem_history(std::move(parts));
    });
}

void faqem_history_destroy(faqem_history* history) { delete history; }

const uint8_t* faqem_history_bytes(const faqem_history* history, size_t* size) {
    if (size) *size = history ? history->bytes.size() : 0;
    return history ? reinterpret_cast<const uint8_t*>(history->bytes.data()) : nullptr;
}

size_t faqem_history_part_count(const faqem_history* history) { return history ? history->parts.size() : 0; }

size_t faqem_history_level_count(const faqem_history* history) {
    return history ? history->parts.front().level_count() : 0;
}

faqem_status faqem_history_truncate(const faqem_history* history, uint64_t faces, faqem_result** result,
                                    faqem_error* error) {
    return capi::catch_exceptions(error, {{result, "result"}}, [&] {
        std::vector<CollapseHistory> truncated = capi::truncate_parts(history, faces);
        if (truncated.size() > 1)
            throw OptionError("the history has " + std::to_string(truncated.size()) +
                              " meshes: use faqem_history_truncate_parts()");
        *result = new faqem_result(restore(std::move(truncated.front())));
    });
}

faqem_status faqem_history_truncate_parts(const faqem_history* history, uint64_t faces,
                                          faqem_result** results, faqem_error* error) {
    return capi::catch_exceptions(error, {{results, "results"}}, [&] {
        std::vector<std::unique_ptr<faqem_result>> objects;
        for (CollapseHistory& part : capi::truncate_parts(history, faces))
            objects.push_back(std::make_unique<faqem_result>(restore(std::move(part))));
        for (std::size_t p = 0; p < objects.size(); ++p) results[p] = objects[p].release();
    });
}

faqem_status faqem_result_map(const faqem_result* result, const uint32_t* faces, const double* barycentric,
                              size_t count, uint32_t* source_faces, double* source_barycentric,
                              faqem_error* error) {
    return capi::catch_exceptions(error, {{faces, "faces"}, {barycentric, "barycentric"}}, [&] {
        const CollapseHistory& history = history_of(result);
        capi::require_argument(source_faces, "source_faces");
        capi::require_argument(source_barycentric, "source_barycentric");
        const auto weights = [&](std::size_t i) {
            return Vec3{barycentric[3 * i], barycentric[3 * i + 1], barycentric[3 * i + 2]};
        };
        for (std::size_t i = 0; i < count; ++i) check_point(history, faces[i], weights(i), i);
        const SurfaceMap map(history);
        for (std::size_t i = 0; i < count; ++i) {
            const SurfacePoint point = map.map(faces[i], weights(i));
            source_faces[i] = point.face;
            for (std::size_t k = 0; k < 3; ++k) source_barycentric[3 * i + k] = point.barycentric[k];
        }
    });
}
