#include "faqem/bake.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "asset/finest_level.hpp"
#include "asset/image/image.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/position_rounding.hpp"
#include "bake/keep/kept_images.hpp"
#include "bake/keep/kept_parts.hpp"
#include "bake/keep/kept_uvs.hpp"
#include "bake/parts/map_parts.hpp"
#include "bake/scene/unencoded_result.hpp"
#include "bake/texture/bake_job.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/error.hpp"
#include "scene/check_asset.hpp"
#include "scene/parts/part_reports.hpp"
#include "scene/position_grids.hpp"
#include "scene/resolved_options.hpp"
#include "scene/touching_parts.hpp"

namespace faqem::detail {

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
        const bool history_fits = part.history.remaining_faces.size() == part.mesh.triangles.size() &&
                                  (part.mesh.triangles.empty() ||
                                   part.history.triangles.size() == source.parts[p].triangles.size());
        if (!history_fits)
            throw InputError("", part_title(source, p),
                             "the history of the simplified mesh is missing or does not match the part");
    }
}

// What an atlas places on the page. An automatic one is of charts or, if these are small, by triangle.
std::string layout_unit(Bake kind) {
    if (kind == Bake::per_triangle) return "triangles";
    return kind == Bake::atlas ? "charts" : "charts or triangles";
}

// Makes the parts that could keep their UVs with them.
PartsWithUvs make_parts_with_uvs(const Asset& source, const SimplifiedParts& simplified, BakeOptions bake,
                                 std::span<const BakePart> parts, const RunContext& context) {
    PartsWithUvs result;
    if (bake.kind != Bake::automatic || simplified.with_uvs.size() != parts.size()) return result;
    result.sets = sets_with_uvs(source, parts, simplified);
    if (result.sets.empty()) return result;
    bake.kind = Bake::keep;
    std::vector<std::uint8_t> is_left_out(parts.size(), 1);
    for (const PartSet& set : result.sets)
        for (const Index p : set) is_left_out[p] = 0;
    const std::vector<BakePart> with_uvs = map_parts(source, simplified.with_uvs, is_left_out, bake, context);
    UnencodedResult baked;
    bake_keep({source, bake, with_uvs, context}, baked);
    result.asset = std::move(baked.asset.asset);
    return result;
}

// Bakes new textures or, if these would have too few texels, vertex colours.
// \param context  may stop it, other than that of the job
// \return false, without changing anything, if the time was over before new textures were complete
bool bake_textures(const BakeJob& job, const RunContext& context, DecodedImages decoded,
                   UnencodedResult& out) {
    const UnencodedResult before = out;
    bool fits = false;
    const auto work = [&](const RunContext& own) {
        own.check_now();
        fits = bake_pages({job.source, job.options, job.parts, own}, std::move(decoded), out);
    };
    if (std::ranges::all_of(job.parts, [](const BakePart& part) { return part.is_kept; })) {
        work(job.context);
    } else if (!context.in_time([&] { work(context); })) {
        out = before;
        return false;
    }
    if (fits) return true;
    out.asset.report.warnings.push_back(
        "more " + layout_unit(job.options.kind) +
        " than texels: the base colour was baked into vertex colours instead");
    bake_vertex(job, out);
    return true;
}

// Sets what files record of the parts: the objects and groups of the faces, which are those of the source faces, and
// the order of vertices and faces. A part that lost faces has no order of its own that a file should preserve.
void keep_file_records(std::span<const BakePart> parts, std::span<const std::uint8_t> untouched,
                       Asset& result) {
    for (const BakePart& part : parts) {
        if (untouched[part.index]) continue;
        Part& to = result.parts[part.index];
        const bool lost_faces = part.faces() < part.source->triangles.size();
        to.file_order = lost_faces ? FileOrder::for_gpu : part.source->file_order;
        for (const FaceArray& array : face_arrays) {
            if (!array.names) continue;
            to.*array.values = gather(part.source->*array.values, part.simplified->history.remaining_faces);
            to.*array.names = part.source->*array.names;
        }
    }
}

// Adds the images of parts that are not baked, and lists those that keep their UVs, but not all vertices.
// \param keeps_images  whether all images stay as they are
void add_kept(const Asset& source, const BakeOptions& bake, std::span<const KeptPart> kept, bool keeps_images,
              const RunContext& context, UnencodedResult& out) {
    for (const KeptPart& part : kept)
        if (!part.keeps_images && !out.asset.asset.parts[part.part].triangles.empty())
            out.asset.report.kept_uvs.push_back(part_title(source, part.part));
    if (!keeps_images) add_kept_images(source, bake, kept, context, out);
}

// Bakes all parts, except for the encoding of images.
// \param requested  the kind before what is automatic was replaced
// \param fits_images  with Bake::keep: whether the images of all parts are pending, instead of those of the source
void bake_parts(const Asset& source, const SimplifiedParts& simplified, const BakeOptions& bake,
                Bake requested, bool fits_images, const RunContext& context, UnencodedResult& out) {
    const Stopwatch watch;
    const RunContext untimed = context.untimed();
    Report& report = out.asset.report;
    const std::vector<std::uint8_t> untouched = find_untouched_parts(source, simplified, bake);
    std::vector<BakePart> parts = map_parts(source, simplified.parts, untouched, bake, untimed);
    const double map_seconds = watch.seconds();

    PartsWithUvs with_uvs = make_parts_with_uvs(source, simplified, bake, parts, untimed);
    DecodedImages decoded;
    ComparedUvs compared;
    if (!with_uvs.sets.empty()) {
        context.in_time([&] {
            context.check_now();
            compared = compare_uvs(source, bake, parts, with_uvs, decoded, context);
        });
    }
    const auto take_with_uvs = [&](std::span<const Index> which) {
        keep_uvs(simplified, which, parts);
        if (!which.empty()) report = report_with_uvs(source, simplified, which);
        report.seconds.map = map_seconds;
    };
    take_with_uvs(compared.good);

    const BakeJob job{source, bake, parts, untimed, requested == Bake::keep};
    const bool is_late = makes_atlas(bake.kind) && !bake_textures(job, context, std::move(decoded), out);
    if (is_late) {
        if (bake.correspondence == Recording::on)
            throw TimeLimitError(
                "max_seconds was over before the texture of the correspondence was complete");
        std::vector<Index> all;
        for (const PartSet& set : with_uvs.sets) all.insert(all.end(), set.begin(), set.end());
        take_with_uvs(all);
        report.warnings.push_back(
            "max_seconds was over before new textures were complete: the images are those of the source");
    }
    const bool keeps_images = is_late || bake.kind == Bake::keep;
    if (keeps_images) bake_keep(job, out);
    if (bake.kind == Bake::vertex) bake_vertex(job, out);
    if (bake.kind == Bake::none) bake_none(job, out);
    std::vector<KeptPart> kept =
        add_kept_parts(source, parts, untouched, std::move(with_uvs.asset), keeps_images, out.asset);
    if (fits_images ||
        (bake.kind == Bake::keep && requested == Bake::automatic && names_objects_by_number(source)))
        for (const BakePart& part : parts)
            if (!part.is_kept) kept.push_back({part.index, false});
    add_kept(source, bake, kept, is_late, untimed, out);
    for (PendingImage& image : out.pending)
        image.quality_change = quality_change(compared.pictures, image.content);
    keep_file_records(parts, untouched, out.asset.asset);
    untimed.report(Phase::bake, 1);
}

// Replaces normals that follow from a smoothing group by this group, unless a new normal map needs them.
void restore_smoothing(const Asset& source, const BakeOptions& bake, Asset& result) {
    if (bake.normals != Normals::automatic || source.smoothing == Smoothing::unknown) return;
    const bool has_normal_map = std::any_of(result.materials.begin(), result.materials.end(),
                                            [](const Material& m) { return bool(m.normal_texture); });
    if (has_normal_map && some_part_has(result, &Part::normals)) return;
    result.smoothing = source.smoothing;
    for (Part& part : result.parts) part.normals.clear();
}

// Calls work(source, resolved options, result) for a result that has the report of the geometry stage and the data of the
// file.
template <class Work>
UnencodedResult run_bake(const Asset& given, const SimplifiedParts& simplified, const Options& requested,
                         const RunContext& context, const Work& work) {
    validate(requested);
    check_asset(given);
    const std::optional<FinestLevel> finest = finest_level(given);
    const Asset& source = finest ? finest->asset : given;
    const Options options = resolved_options(source, requested);
    check_parts_match(source, simplified);
    context.show(Phase::map, 0);
    UnencodedResult out;
    Report& report = out.asset.report = simplified.report;
    out.asset.asset.source = source.source;
    out.asset.asset.format = options.format;
    out.asset.asset.warnings = source.warnings;
    out.asset.asset.precision = source.precision;
    if (report.stop == StopReason::cancelled) throw engine::Cancelled{};
    const Stopwatch watch;
    work(source, options, out);
    restore_smoothing(source, options.bake, out.asset.asset);
    // Those of simplify_parts() are rounded already, those of histories are not.
    const StoredPrecision precision = result_precision(source, options.format);
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        Part& part = out.asset.asset.parts[p];
        round_positions(precision, part.triangles, part.positions);
        const std::size_t vertices = part.positions.size();
        const std::size_t unsplit = simplified.parts[p].mesh.positions.size();
        report.vertices_split += vertices - std::min(vertices, unsplit);
    }
    set_quantization(source, options, out.asset.asset, report);
    divide_joined_parts(source, out.asset);
    report.seconds.bake = watch.seconds() - report.seconds.map;
    report.seconds.total += watch.seconds();
    return out;
}

}  // namespace

UnencodedResult bake_unencoded(const Asset& given, const SimplifiedParts& simplified,
                               const Options& requested, const RunContext& context) {
    const auto work = [&](const Asset& source, const Options& options, UnencodedResult& out) {
        if (options.bake.correspondence == Recording::on && !makes_atlas(options.bake.kind))
            throw OptionError("correspondence requires a new atlas: bake must not be vertex, keep or none");
        if (options.bake.kind == Bake::keep && requested.bake.kind != Bake::keep &&
            std::any_of(source.images.begin(), source.images.end(), is_passed_through))
            out.asset.report.warnings.push_back(
                "images of KTX2, AVIF, DDS and of unknown kinds cannot be baked: the UVs and images of the "
                "source are kept");
        bake_parts(source, simplified, options.bake, requested.bake.kind, false, context, out);
    };
    return run_bake(given, simplified, requested, context, work);
}

UnencodedResult bake_with_uvs(const Asset& given, const SimplifiedParts& simplified, const Options& requested,
                              const RunContext& context) {
    const auto work = [&](const Asset& source, const Options& options, UnencodedResult& out) {
        BakeOptions bake = options.bake;
        bake.kind = Bake::keep;
        bake.untouched = UntouchedParts::baked;
        bake_parts(source, simplified, bake, Bake::automatic, true, context.untimed(), out);
        for (Part& part : out.asset.asset.parts) part.file_order = FileOrder::for_gpu;
    };
    return run_bake(given, simplified, requested, context, work);
}

SimplifiedAsset bake_encoded(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                             const RunContext& context) {
    UnencodedResult result = bake_unencoded(source, simplified, options, context);
    encode_images(result, options, context);
    return std::move(result.asset);
}

}  // namespace faqem::detail
