#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "bake/groups.hpp"
#include "bake/job.hpp"
#include "faqem/bake.hpp"
#include "faqem/engine/weld.hpp"

namespace faqem {
namespace {

std::size_t faces_of(const Asset& asset, std::size_t part) { return asset.parts[part].triangles.size(); }

// The fewest faces that show every component of a part: 4 for each, or all it has. O(faces)
std::uint64_t faces_of_components(const Part& part) {
    const std::vector<Index> welded = engine::weld_exact(part.positions);
    std::vector<Index> parent(welded.size());
    std::iota(parent.begin(), parent.end(), Index{0});
    const auto root = [&](Index v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const Triangle& t : part.triangles) {
        for (const Index v : {t[1], t[2]}) {
            const Index r = root(welded[t[0]]), s = root(welded[v]);
            parent[std::max(r, s)] = std::min(r, s);
        }
    }
    std::vector<std::uint8_t> counted(welded.size(), 0);
    std::uint64_t sum = 0;
    for (const Triangle& t : part.triangles) {
        std::uint8_t& count = counted[root(welded[t[0]])];
        if (count == 4) continue;
        ++count;
        ++sum;
    }
    return sum;
}

// What no part's share may fall below. Components go before the target where the target has no room for them.
std::vector<std::uint64_t> least_shares(const Asset& asset, std::uint64_t goal) {
    std::vector<std::uint64_t> least;
    std::uint64_t sum = 0;
    for (const Part& part : asset.parts) sum += least.emplace_back(faces_of_components(part));
    for (std::size_t p = 0; p < least.size() && sum > goal; ++p)
        least[p] = std::min<std::uint64_t>(4, faces_of(asset, p));
    return least;
}

// Shares of a face count in proportion to the parts' faces, by largest remainder; parts whose share would be
// below their least are given that, and the others pay for it.
std::vector<std::uint64_t> share_out(const Asset& asset, std::uint64_t goal) {
    const std::size_t parts = asset.parts.size();
    std::vector<std::uint64_t> share = least_shares(asset, goal);
    double rest = 0, left = static_cast<double>(goal);
    std::vector<std::size_t> order;
    for (std::size_t p = 0; p < parts; ++p) {
        rest += static_cast<double>(faces_of(asset, p));
        if (faces_of(asset, p) > 0) order.push_back(p);
    }
    const auto least_ratio = [&](std::size_t p) {
        return static_cast<double>(share[p]) / static_cast<double>(faces_of(asset, p));
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return least_ratio(a) > least_ratio(b); });
    auto first = order.begin();
    for (; first != order.end() && least_ratio(*first) * rest > left; ++first) {
        rest -= static_cast<double>(faces_of(asset, *first));
        left -= static_cast<double>(share[*first]);
    }
    order.erase(order.begin(), first);
    std::sort(order.begin(), order.end());
    const double ratio = order.empty() ? 0 : left / rest;
    std::vector<double> remainder(parts, 0);
    for (const std::size_t p : order) {
        const double exact = ratio * static_cast<double>(faces_of(asset, p));
        share[p] = std::max(share[p], static_cast<std::uint64_t>(exact));
        remainder[p] = exact - static_cast<double>(share[p]);
        left -= static_cast<double>(share[p]);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return remainder[a] > remainder[b]; });
    for (std::size_t i = 0; i < order.size() && left >= 1; ++i, --left) ++share[order[i]];
    for (const std::size_t p : order) share[p] = std::min<std::uint64_t>(share[p], faces_of(asset, p));
    return share;
}

// floor() of a share may not lose a face to rounding: 0.1 * 30 is 3.
std::uint64_t faces_wanted(const Target& target, double faces) {
    const double wanted =
        target.kind == Target::Kind::faces ? target.value : target.value * faces * (1 + 1e-15);
    return static_cast<std::uint64_t>(std::floor(std::min(wanted, faces)));
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
    // The target of a part is 4 at least, even where it has fewer faces.
    sum.target_faces += std::min(part.target_faces, part.faces_in);
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
    double total = 0, done = 0;
    for (const Part& part : source.parts) total += static_cast<double>(part.triangles.size());
    const std::vector<std::uint64_t> share = share_out(source, faces_wanted(options.target, total));

    SmallParts result;
    result.report.preset = options.preset;
    result.parts.resize(source.parts.size());
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const Part& part = source.parts[p];
        if (part.triangles.empty() || result.report.stop == StopReason::cancelled) continue;
        const double size = static_cast<double>(part.triangles.size());
        Options own = options;
        own.history = Recording::on;
        own.target = faces(share[p]);
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
