#include "faqem/bake.hpp"

#include <optional>
#include <string>
#include <utility>

#include "asset/image/image.hpp"
#include "asset/image/image_size.hpp"
#include "asset/scene/messages.hpp"
#include "bake/scene/check_asset.hpp"
#include "bake/scene/untouched_parts.hpp"
#include "bake/texture/bake_job.hpp"
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

// Without textures and transferred normals, the map is needed only for skin weights and morph targets.
bool needs_map(const Part& part, const BakeOptions& bake) {
    const bool is_bare = bake.kind == Bake::none && bake.normals != Normals::transfer;
    return !is_bare || !part.joints.empty() || !part.morph_targets.empty();
}

// Makes the surface maps and the normals of all parts.
void map_parts(BakeJob& job, const SimplifiedParts& simplified) {
    double done = 0;
    for (std::size_t p = 0; p < job.source.parts.size(); ++p) {
        job.report_progress(Phase::map, done++ / static_cast<double>(job.source.parts.size()));
        BakePart part{static_cast<Index>(p), &job.source.parts[p], &simplified.parts[p], nullptr};
        if (part.faces() > 0 && !job.untouched[p] && needs_map(*part.source, job.options.bake)) {
            part.map = std::make_unique<const SurfaceMap>(make_surface_map(
                part.simplified->history, job.options.bake.mapping, part.source->triangles, job.workers()));
        }
        job.parts.push_back(std::move(part));
    }
    for (const BakePart& part : job.parts) {
        job.report_progress(Phase::map, 1);
        const bool has_normals =
            part.faces() > 0 && !job.untouched[part.index] && job.options.bake.normals != Normals::none;
        job.normals.push_back(has_normals ? make_normals(part, job.options.bake, job.workers())
                                          : CornerNormals{});
    }
}

// What an atlas places on the page. An automatic one is of charts or, if these are small, by triangle.
std::string layout_unit(Bake kind) {
    if (kind == Bake::per_triangle) return "triangles";
    return kind == Bake::atlas ? "charts" : "charts or triangles";
}

void bake_by_kind(BakeJob& job) {
    switch (job.options.bake.kind) {
        case Bake::automatic:
        case Bake::atlas:
        case Bake::per_triangle:
            if (bake_pages(job)) return;
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
void set_file_orders(BakeJob& job) {
    for (const BakePart& part : job.parts) {
        if (job.untouched[part.index]) continue;
        const bool lost_faces = part.faces() < part.source->triangles.size();
        job.result.asset.parts[part.index].file_order =
            lost_faces ? FileOrder::for_gpu : part.source->file_order;
    }
}

void report_images(const Asset& asset, Report& report) {
    for (const Image& image : asset.images) {
        const std::optional<ImageSize> size = declared_size(image.encoded);
        const auto side = [&](std::uint64_t ImageSize::*member) {
            return size ? static_cast<std::uint32_t>(*size.*member) : 0;
        };
        report.images.push_back({image.name, sniff_mime_type(image.encoded), side(&ImageSize::width),
                                 side(&ImageSize::height), image.encoded.size()});
    }
}

// Bakes the parts with their histories. The callers add the histories to the result: one copies them, the
// other moves them.
SimplifiedAsset bake_parts(const Asset& source, const SimplifiedParts& simplified, const Options& options) {
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
    if (simplified.report.stop == StopReason::cancelled) return std::move(job.result);
    PhaseSeconds& seconds = job.result.report.seconds;
    const Stopwatch watch;
    job.untouched = find_untouched_parts(source, simplified, options.bake);
    try {
        map_parts(job, simplified);
        seconds.map = watch.seconds();
        bake_by_kind(job);
        set_file_orders(job);
        add_untouched_parts(job);
        report_images(job.result.asset, job.result.report);
        job.report_progress(Phase::bake, 1);
    } catch (const engine::Cancelled&) {
        job.result.asset.parts.clear();
        job.result.asset.materials.clear();
        job.result.asset.images.clear();
        job.result.correspondence.clear();
        job.result.report.stop = StopReason::cancelled;
    }
    seconds.bake = watch.seconds() - seconds.map;
    seconds.total += watch.seconds();
    return std::move(job.result);
}

}  // namespace
}  // namespace detail

SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options) {
    SimplifiedAsset result = detail::bake_parts(source, simplified, options);
    if (options.history == Recording::on) {
        for (const SimplifyResult& part : simplified.parts) result.histories.push_back(part.history);
    }
    return result;
}

SimplifiedAsset simplify(const Asset& source, const Options& options) {
    SimplifiedParts simplified = simplify_parts(source, options);
    SimplifiedAsset result = detail::bake_parts(source, simplified, options);
    if (options.history == Recording::on) {
        for (SimplifyResult& part : simplified.parts) result.histories.push_back(std::move(part.history));
    }
    return result;
}

}  // namespace faqem
