#include "capi/c_levels.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "capi/c_mesh.hpp"
#include "capi/c_result.hpp"
#include "capi/guard.hpp"

namespace {

using namespace faqem;

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
