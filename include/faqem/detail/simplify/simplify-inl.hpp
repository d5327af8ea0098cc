#pragma once

#include "faqem/simplify.hpp"

#include "faqem/detail/measure/removed_components.hpp"
#include "faqem/detail/simplify/error_bound_search.hpp"
#include "faqem/detail/simplify/run.hpp"

FAQEM_NAMESPACE_BEGIN

FAQEM_INLINE SimplifyResult simplify(const MeshView& mesh, const Options& options) {
    validate(options);
    const engine::RunContext context(options);
    const auto run = [&](const Options& with_target, const engine::RunContext& of_run) {
        const std::uint64_t target =
            detail::target_face_count(with_target.target, static_cast<double>(mesh.triangles.size()));
        return std::move(detail::run_to_targets(mesh, {&target, 1}, with_target, of_run).front());
    };
    SimplifyResult result = options.max_error ? detail::simplify_within_error(mesh, options, context, run)
                                              : run(options, context);
    detail::report_removed_components(mesh, result);
    return result;
}

FAQEM_NAMESPACE_END
