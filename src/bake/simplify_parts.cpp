#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "bake/groups.hpp"
#include "bake/job.hpp"
#include "faqem/bake.hpp"

namespace faqem {
namespace {

std::size_t faces_of(const Asset& asset, std::size_t part) { return asset.parts[part].triangles.size(); }

// Shares of a face count in proportion to the parts' faces, by largest remainder; at least min(4, faces)
// each.
std::vector<std::uint64_t> share_out(const Asset& asset, double wanted) {
    const std::size_t parts = asset.parts.size();
    double total = 0;
    for (std::size_t p = 0; p < parts; ++p) total += static_cast<double>(faces_of(asset, p));
    const double goal = std::floor(std::min(wanted, total));
    std::vector<std::uint64_t> share(parts, 0);
    std::vector<double> remainder(parts, 0);
    double left = goal;
    for (std::size_t p = 0; p < parts && total > 0; ++p) {
        const double exact = goal * (static_cast<double>(faces_of(asset, p)) / total);
        share[p] = static_cast<std::uint64_t>(exact);
        remainder[p] = exact - std::floor(exact);
        left -= std::floor(exact);
    }
    std::vector<std::size_t> order(parts);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return remainder[a] > remainder[b]; });
    for (std::size_t i = 0; i < parts && left >= 1; ++i, --left) ++share[order[i]];
    for (std::size_t p = 0; p < parts; ++p) {
        const std::uint64_t faces = faces_of(asset, p);
        share[p] = std::clamp(share[p], std::min<std::uint64_t>(4, faces), faces);
    }
    return share;
}

// UVs and colours of a part on its corners.
CornerAttributes corner_attributes(const Part& part) {
    CornerAttributes result;
    result.width = static_cast<std::uint32_t>(2 * part.uvs.size() + (part.colors.empty() ? 0 : 4));
    result.values.reserve(3 * part.triangles.size() * result.width);
    for (const Triangle& t : part.triangles) {
        for (Index v : t) {
            for (const auto& uvs : part.uvs)
                result.values.insert(result.values.end(), uvs[v].begin(), uvs[v].end());
            if (part.colors.empty()) continue;
            result.values.insert(result.values.end(), part.colors[v].begin(), part.colors[v].end());
        }
    }
    return result;
}

// The engine's groups: where materials are baked into one page they are one group, so that borders between
// them cost no faces and samples may cross them; elsewhere they are the materials themselves.
std::vector<Index> engine_groups(const Part& part, const std::optional<detail::MaterialGroups>& groups) {
    std::vector<Index> result;
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        const Index material = detail::face_material(part, f);
        result.push_back(groups ? groups->of(material) : material);
    }
    const bool one = std::all_of(result.begin(), result.end(), [&](Index g) { return g == result.front(); });
    return one ? std::vector<Index>{} : result;
}

void add(Report& sum, const Report& part, const std::string& title) {
    sum.faces_in += part.faces_in;
    sum.faces_out += part.faces_out;
    sum.vertices_in += part.vertices_in;
    sum.vertices_out += part.vertices_out;
    sum.target_faces += part.target_faces;
    if (part.stop != StopReason::reached_target && sum.stop != StopReason::cancelled) sum.stop = part.stop;
    sum.collapses += part.collapses;
    for (std::size_t i = 0; i < refusal_kinds; ++i) sum.refusals[i] += part.refusals[i];
    for (std::size_t i = 0; i < rung_kinds; ++i) sum.rungs[i] += part.rungs[i];
    sum.faces_dropped += part.faces_dropped;
    sum.components_deleted += part.components_deleted;
    sum.virtual_edges += part.virtual_edges;
    for (const std::string& warning : part.warnings) sum.warnings.push_back(title + ": " + warning);
    sum.seconds.weld += part.seconds.weld;
    sum.seconds.simplify += part.seconds.simplify;
}

}  // namespace

SmallParts simplify_parts(const Asset& source, const Options& options) {
    validate(options);
    const detail::Stopwatch watch;
    const bool merged = options.bake.kind == Bake::per_triangle || options.bake.kind == Bake::vertex;
    std::optional<detail::MaterialGroups> groups;
    if (merged) groups = detail::group_materials(source, options.bake.kind);
    std::vector<std::uint64_t> share;
    if (options.target.kind == Target::Kind::faces) share = share_out(source, options.target.value);
    double total = 0, done = 0;
    for (const Part& part : source.parts) total += static_cast<double>(part.triangles.size());

    SmallParts result;
    result.report.preset = options.preset;
    result.parts.resize(source.parts.size());
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const Part& part = source.parts[p];
        if (part.triangles.empty() || result.report.stop == StopReason::cancelled) continue;
        const double size = static_cast<double>(part.triangles.size());
        Options own = options;
        own.history = Recording::on;
        if (!share.empty()) own.target = faces(share[p]);
        if (options.progress) {
            own.progress = [&](Phase phase, double fraction) {
                return options.progress(phase, std::min(1.0, (done + fraction * size) / total));
            };
        }
        const std::vector<Index> face_groups = engine_groups(part, groups);
        CornerAttributes attributes;
        if (options.bake.kind == Bake::keep) attributes = corner_attributes(part);
        MeshView view{
            part.positions, part.triangles, face_groups, attributes.width ? &attributes : nullptr, {}};
        result.parts[p] = simplify(view, own);
        add(result.report, result.parts[p].report, detail::part_title(source, p));
        done += size;
    }
    result.report.seconds.total = watch.seconds();
    return result;
}

}  // namespace faqem
