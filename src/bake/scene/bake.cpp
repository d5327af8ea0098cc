#include "faqem/bake.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene/messages.hpp"
#include "bake/keep/kept_parts.hpp"
#include "bake/keep/kept_uvs.hpp"
#include "bake/keep/untouched_parts.hpp"
#include "bake/scene/check_asset.hpp"
#include "bake/scene/unencoded_result.hpp"
#include "bake/texture/bake_job.hpp"
#include "faqem/detail/base/time_limit.hpp"
#include "faqem/error.hpp"

namespace faqem {

namespace detail {

namespace {

void check_parts_match(const Asset& source, const SimplifiedParts& simplified) {
    if (simplified.parts.size() != source.parts.size()) {
        throw InputError("", "simplified parts",
                         "there are " + std::to_string(simplified.parts.size()) +
                             ", but the number of parts of the asset is " +
                             std::to_string(source.parts.size()));
    }
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const SimplifyResult& part = simplified.parts[p];
        const bool history_fits = part.history.kept_faces.size() == part.mesh.triangles.size() &&
                                  (part.mesh.triangles.empty() ||
                                   part.history.triangles.size() == source.parts[p].triangles.size());
        if (!history_fits) {
            throw InputError("", part_title(source, p),
                             "the history of the simplified mesh is missing or does not match the part");
        }
    }
}

// What an atlas places on the page. An automatic one is of charts or, if these are small, by triangle.
std::string layout_unit(Bake kind) {
    if (kind == Bake::per_triangle) return "triangles";
    return kind == Bake::atlas ? "charts" : "charts or triangles";
}

// Bakes new textures. If the time is over before they are complete, keeps the UVs and images of the source.
// \return false as bake_pages()
bool bake_pages_in_time(BakeJob& job, const SimplifiedParts& simplified, const KeptUvs& kept) {
    if (std::count(job.skipped.begin(), job.skipped.end(), 0) == 0) return bake_pages(job);
    const SimplifiedAsset before = job.result;
    bool is_baked = false;
    if (job.run_in_time([&] { is_baked = bake_pages(job); })) return is_baked;
    if (job.options.bake.correspondence == Recording::on)
        throw TimeLimitError("max_seconds was over before the texture of the correspondence was complete");
    job.result = before;
    job.pending.clear();
    job.is_late = true;
    job.warn("max_seconds was over before new textures were complete: the images are those of the source");
    keep_all_candidates(job, simplified, kept);
    bake_keep(job);
    return true;
}

void bake_by_kind(BakeJob& job, const SimplifiedParts& simplified, const KeptUvs& kept) {
    switch (job.options.bake.kind) {
        case Bake::automatic:
        case Bake::atlas:
        case Bake::per_triangle:
            if (bake_pages_in_time(job, simplified, kept)) return;
            job.warn("more " + layout_unit(job.options.bake.kind) +
                     " than texels: the base colour was baked into vertex colours instead");
            return bake_vertex(job);
        case Bake::vertex:
            return bake_vertex(job);
        case Bake::keep:
            return bake_keep(job);
        case Bake::none:
            return bake_none(job);
    }
}

// A part that lost faces has no order of its own that a file should preserve.
void set_file_orders(BakeJob& job, std::span<const std::uint8_t> untouched) {
    for (const BakePart& part : job.parts) {
        if (untouched[part.index]) continue;
        const bool lost_faces = part.faces() < part.source->triangles.size();
        job.result.asset.parts[part.index].file_order =
            lost_faces ? FileOrder::for_gpu : part.source->file_order;
    }
}

// The faces of the result belong to the objects of the faces that they were.
void keep_objects(BakeJob& job, std::span<const std::uint8_t> untouched) {
    for (const BakePart& part : job.parts) {
        if (untouched[part.index] || part.source->face_object.empty()) continue;
        Part& to = job.result.asset.parts[part.index];
        to.object_names = part.source->object_names;
        to.face_object.clear();
        for (const Index f : part.simplified->history.kept_faces)
            to.face_object.push_back(part.source->face_object[f]);
    }
}

}  // namespace

UnencodedResult bake_unencoded(const Asset& source, const SimplifiedParts& simplified,
                               const Options& options) {
    validate(options);
    check_asset(source);
    check_parts_match(source, simplified);
    if (options.bake.correspondence == Recording::on && !makes_atlas(options.bake.kind)) {
        throw OptionError("correspondence requires a new atlas: bake must not be vertex, keep or none");
    }
    BakeJob job(source, options);
    job.result.report = simplified.report;
    job.result.asset.source = source.source;
    job.result.asset.warnings = source.warnings;
    job.result.asset.compression =
        options.compress == Compression::source ? source.compression : options.compress;
    if (simplified.report.stop == StopReason::cancelled) return {std::move(job.result), {}};
    PhaseSeconds& seconds = job.result.report.seconds;
    const Stopwatch watch;
    const std::vector<std::uint8_t> untouched = find_untouched_parts(source, simplified, options.bake);
    job.skipped = untouched;
    try {
        map_parts(job, simplified.parts);
        seconds.map = watch.seconds();
        KeptUvs kept = choose_kept_uvs(job, simplified);
        bake_by_kind(job, simplified, kept);
        add_kept_parts(job, untouched, std::move(kept));
        set_file_orders(job, untouched);
        keep_objects(job, untouched);
        for (PendingImage& image : job.pending)
            image.quality_change = quality_change(job.pictures, image.content);
        job.report_progress(Phase::bake, 1);
    } catch (const engine::Cancelled&) {
        set_cancelled(job.result);
        job.pending.clear();
    }
    seconds.bake = watch.seconds() - seconds.map;
    seconds.total += watch.seconds();
    return {std::move(job.result), std::move(job.pending)};
}

}  // namespace detail

SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options) {
    const detail::Deadline deadline = detail::deadline_of(options);
    detail::UnencodedResult result = detail::bake_unencoded(source, simplified, options);
    detail::encode_images(result, detail::with_time_left(options, deadline));
    if (options.history == Recording::on) {
        for (const SimplifyResult& part : simplified.parts) result.asset.histories.push_back(part.history);
    }
    return std::move(result.asset);
}

SimplifiedAsset simplify(const Asset& source, const Options& options) {
    const detail::Deadline deadline = detail::deadline_of(options);
    SimplifiedParts simplified = simplify_parts(source, options);
    detail::UnencodedResult result =
        detail::bake_unencoded(source, simplified, detail::with_time_left(options, deadline));
    detail::encode_images(result, detail::with_time_left(options, deadline));
    if (options.history == Recording::on) {
        for (SimplifyResult& part : simplified.parts)
            result.asset.histories.push_back(std::move(part.history));
    }
    return std::move(result.asset);
}

}  // namespace faqem
