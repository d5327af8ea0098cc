#pragma once

#include "faqem/truncate.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/detail/history/binary_io.hpp"
#include "faqem/detail/history/final_versions.hpp"
#include "faqem/error.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

inline std::string numbered(std::size_t level) { return "level " + std::to_string(level); }

// Whether the collapses and deletions of `part` are the first ones of `whole`, for the same original.
inline bool is_prefix_of(const CollapseHistory& part, const CollapseHistory& whole) {
    const auto is_prefix = [](const auto& a, const auto& b) {
        return std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first == a.end();
    };
    return part.positions == whole.positions && part.triangles == whole.triangles &&
           part.face_groups == whole.face_groups && is_prefix(part.collapses, whole.collapses) &&
           is_prefix(part.deleted_faces, whole.deleted_faces);
}

inline HistoryLevel level_from_history(const CollapseHistory& history) {
    HistoryLevel level;
    level.collapses = history.collapses.size();
    level.deleted = history.deleted_faces.size();
    for (std::size_t k = history.collapses.size(); k < history.patch_count(); ++k)
        level.flips.push_back({history.patch(k)[0], history.patch(k)[1]});
    level.remaining_versions = history.remaining_versions;
    level.remaining_faces = history.remaining_faces;
    level.final_positions = history.final_positions;
    return level;
}

// A history with the first collapses and deletions of `whole`, without remaining elements.
inline CollapseHistory history_prefix(const CollapseHistory& whole, std::size_t collapses,
                                      std::size_t deleted) {
    CollapseHistory h;
    if (whole.patch_begin.empty()) return h;  // empty history
    h.positions = whole.positions;
    h.triangles = whole.triangles;
    h.face_groups = whole.face_groups;
    const auto first = [](const auto& of, std::size_t n) {
        return std::decay_t<decltype(of)>(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(n));
    };
    h.collapses = first(whole.collapses, collapses);
    h.patch_begin = first(whole.patch_begin, collapses + 1);
    h.patch_faces = first(whole.patch_faces, static_cast<std::size_t>(h.patch_begin.back()));
    h.deleted_faces = first(whole.deleted_faces, deleted);
    return h;
}

// Number of collapses and deletions of a history.
struct HistoryLength {
    std::size_t collapses = 0, deleted = 0;
    bool operator==(const HistoryLength&) const = default;
};

inline HistoryLength length_at_level(const ChainHistory& history, std::size_t level) {
    if (level == history.before.size())
        return {history.last.collapses.size(), history.last.deleted_faces.size()};
    return {static_cast<std::size_t>(history.before[level].collapses),
            static_cast<std::size_t>(history.before[level].deleted)};
}

inline std::size_t faces_at_level(const ChainHistory& history, std::size_t level) {
    return level == history.before.size() ? history.last.remaining_faces.size()
                                          : history.before[level].remaining_faces.size();
}

// Whether collapses k - 1 and k belong to one contraction (engine::Contraction), which is done as a whole: they have
// the same survivor and position, and k - 1 leaves an edge with more than two faces or two faces with equal corners.
// \param corners  of each face before collapse k, as versions
inline bool is_within_contraction(const CollapseHistory& h, std::size_t k,
                                  std::span<const Triangle> corners) {
    if (k == 0 || k >= h.collapses.size()) return false;
    const Index center = static_cast<Index>(h.positions.size() + k - 1);
    const Collapse &before = h.collapses[k - 1], &next = h.collapses[k];
    if (next.first != center || next.position != before.position) return false;
    std::vector<Index> ends;
    std::vector<std::pair<Index, Index>> opposite;
    for (const Index f : h.patch(k - 1)) {
        if (corners[f][0] == no_index) continue;
        Triangle t = corners[f];
        std::rotate(t.begin(), std::find(t.begin(), t.end(), center), t.end());
        ends.insert(ends.end(), {t[1], t[2]});
        opposite.push_back(std::minmax(t[1], t[2]));
    }
    std::sort(ends.begin(), ends.end());
    std::sort(opposite.begin(), opposite.end());
    for (std::size_t i = 2; i < ends.size(); ++i)
        if (ends[i] == ends[i - 2]) return true;
    return std::adjacent_find(opposite.begin(), opposite.end()) != opposite.end();
}

// The point at which a run to the given face count would have stopped. Faces are counted as by the collapse
// loop, that is, with faces of zero area. All deletions between two collapses belong together, and all collapses
// of a contraction.
inline HistoryLength length_at_face_count(const CollapseHistory& h, std::uint64_t faces) {
    const Index made = static_cast<Index>(h.positions.size());
    std::vector<Triangle> corners = h.triangles;
    std::size_t left = face_count(corners);
    const auto remove = [&](Index f) {
        if (corners[f][0] == no_index) return;
        corners[f][0] = no_index;
        --left;
    };
    HistoryLength now;
    const auto remove_deleted = [&] {
        while (now.deleted < h.deleted_faces.size() && h.deleted_faces[now.deleted].time == now.collapses)
            remove(h.deleted_faces[now.deleted++].face);
    };
    remove_deleted();  // includes the pruned components
    while ((left > faces && now.collapses < h.collapses.size()) ||
           is_within_contraction(h, now.collapses, corners)) {
        const Collapse& c = h.collapses[now.collapses];
        for (const Index f : h.patch(now.collapses)) {
            if (corners[f][0] == no_index) continue;
            Index replaced = 0;
            for (Index& v : corners[f]) {
                if (v != c.first && v != c.second) continue;
                v = made + static_cast<Index>(now.collapses);
                ++replaced;
            }
            if (replaced > 1) remove(f);
        }
        ++now.collapses;
        if (left > faces) remove_deleted();
    }
    return now;
}

// Sets remaining_versions and remaining_faces like a run that ends there: in input order, without faces of zero area.
inline void fill_remaining_elements(CollapseHistory& h) {
    const std::vector<Index> last = detail::final_versions(h);
    std::vector<std::uint8_t> is_deleted(h.triangles.size(), 0);
    for (const DeletedFace& deleted : h.deleted_faces) is_deleted[deleted.face] = 1;
    // Vertices are sorted by slot; a collapse puts the new version into the slot of its first version.
    std::vector<Index> slot = engine::all_indices(last.size());
    for (std::size_t k = 0; k < h.collapses.size(); ++k)
        slot[h.positions.size() + k] = slot[h.collapses[k].first];
    std::vector<Index> version_at(h.positions.size(), no_index);
    for (Index f = 0; f < h.triangles.size(); ++f) {
        const Triangle& t = h.triangles[f];
        if (t[0] == no_index || is_deleted[f]) continue;
        const Triangle now = {last[t[0]], last[t[1]], last[t[2]]};
        if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
        if (detail::has_no_area(h.position(now[0]), h.position(now[1]), h.position(now[2]))) continue;
        h.remaining_faces.push_back(f);
        for (const Index v : now) version_at[slot[v]] = v;
    }
    for (const Index v : version_at)
        if (v != no_index) h.remaining_versions.push_back(v);
}

// \throws InputError  if the parts have different numbers of levels
inline void check_same_count(std::span<const ChainHistory> parts) {
    for (const ChainHistory& part : parts)
        if (part.level_count() != parts.front().level_count())
            throw InputError("history", "levels", "the parts have different numbers of levels");
}

}  // namespace detail

FAQEM_INLINE ChainHistory join(std::span<const CollapseHistory> levels) {
    if (levels.empty()) throw InputError("history", "levels", "at least one level is required");
    ChainHistory result;
    result.last = levels.back();
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        if (!detail::is_prefix_of(levels[i], levels[i + 1]))
            detail::fail_history(detail::numbered(i), "the next level is not from the same run");
        result.before.push_back(detail::level_from_history(levels[i]));
    }
    return result;
}

FAQEM_INLINE CollapseHistory truncate_to_level(const ChainHistory& history, std::size_t level) {
    if (level == history.before.size()) return history.last;
    const HistoryLevel& end = history.before[level];
    const detail::HistoryLength length = detail::length_at_level(history, level);
    CollapseHistory h = detail::history_prefix(history.last, length.collapses, length.deleted);
    for (const auto& [s, t] : end.flips) {
        h.patch_faces.insert(h.patch_faces.end(), {s, t});
        h.patch_begin.push_back(h.patch_faces.size());
    }
    h.remaining_versions = end.remaining_versions;
    h.remaining_faces = end.remaining_faces;
    h.final_positions = end.final_positions;
    return h;
}

FAQEM_INLINE CollapseHistory truncate_to_faces(const ChainHistory& history, std::uint64_t faces) {
    const std::size_t levels = history.level_count();
    for (std::size_t i = 0; i < levels; ++i)
        if (detail::faces_at_level(history, i) == faces) return truncate_to_level(history, i);
    const detail::HistoryLength length = detail::length_at_face_count(history.last, faces);
    for (std::size_t i = 0; i < levels; ++i)
        if (detail::length_at_level(history, i) == length) return truncate_to_level(history, i);
    CollapseHistory h = detail::history_prefix(history.last, length.collapses, length.deleted);
    detail::fill_remaining_elements(h);
    return h;
}

FAQEM_INLINE std::vector<CollapseHistory> truncate_to_faces(std::span<const ChainHistory> parts,
                                                            std::uint64_t faces) {
    std::vector<CollapseHistory> result;
    if (parts.empty()) return result;
    detail::check_same_count(parts);
    // Face count of a part. Level 0 is the original, level i + 1 is level i of the history.
    const auto faces_of = [](const ChainHistory& part, std::size_t level) -> std::uint64_t {
        return level > 0 ? detail::faces_at_level(part, level - 1) : detail::face_count(part.last.triangles);
    };
    const auto faces_of_all = [&](std::size_t level) {
        std::uint64_t sum = 0;
        for (const ChainHistory& part : parts) sum += faces_of(part, level);
        return sum;
    };
    const std::size_t levels = parts.front().level_count();
    std::size_t below = 0;
    while (below < levels && faces_of_all(below) > faces) ++below;
    const bool is_level = below > 0 && faces_of_all(below) >= faces;  // > only for the last level
    if (is_level) {
        for (const ChainHistory& part : parts) result.push_back(truncate_to_level(part, below - 1));
        return result;
    }
    if (parts.size() == 1 || below == 0) {
        for (const ChainHistory& part : parts)
            result.push_back(truncate_to_faces(part, below == 0 ? faces_of(part, 0) : faces));
        return result;
    }
    const std::uint64_t fewer = faces_of_all(below), more = faces_of_all(below - 1);
    const double share = static_cast<double>(faces - fewer) / static_cast<double>(more - fewer);
    for (const ChainHistory& part : parts) {
        const std::uint64_t least = faces_of(part, below);
        const auto extra = static_cast<double>(faces_of(part, below - 1) - least);
        result.push_back(truncate_to_faces(part, least + static_cast<std::uint64_t>(share * extra)));
    }
    return result;
}

FAQEM_INLINE SimplifyResult restore(CollapseHistory history) {
    SimplifyResult result;
    result.mesh = replay(history);
    Report& report = result.report;
    report.faces_in = history.triangles.size();
    report.faces_out = result.mesh.triangles.size();
    report.vertices_in = history.positions.size();
    report.vertices_out = result.mesh.positions.size();
    report.collapses = history.collapses.size();
    result.face_origin = history.remaining_faces;
    result.history = std::move(history);
    return result;
}

FAQEM_INLINE void write(const ChainHistory& history, std::ostream& out) {
    detail::put(out, detail::chain_magic);
    write(history.last, out);
    detail::put(out, static_cast<std::uint64_t>(history.before.size()));
    for (const HistoryLevel& level : history.before) {
        detail::put(out, level.collapses);
        detail::put(out, level.deleted);
        detail::put_array(out, level.flips);
        detail::put_array(out, level.final_positions);
        detail::put_array(out, level.remaining_versions);
        detail::put_array(out, level.remaining_faces);
    }
    out.flush();
    if (!out) throw WriteError("cannot write the history");
}

FAQEM_INLINE ChainHistory read_chain_history(std::istream& in) {
    ChainHistory history;
    const auto magic = detail::get<detail::HistoryMagic>(in, "header");
    if (magic == detail::history_magic) {
        history.last = detail::read_history_body(in);
        return history;
    }
    if (magic != detail::chain_magic)
        detail::fail_history("header", "not a collapse history, or of an unsupported version");
    history.last = read_history(in);
    const auto count = detail::get<std::uint64_t>(in, "levels");
    detail::HistoryLength latest;
    for (std::uint64_t i = 0; i < count; ++i) {
        HistoryLevel& level = history.before.emplace_back();
        level.collapses = detail::get<std::uint64_t>(in, "levels");
        level.deleted = detail::get<std::uint64_t>(in, "levels");
        level.flips = detail::get_array<std::array<Index, 2>>(in, "levels");
        level.final_positions = detail::get_array<Vec3>(in, "levels");
        level.remaining_versions = detail::get_array<Index>(in, "levels");
        level.remaining_faces = detail::get_array<Index>(in, "levels");
        const bool is_monotone = level.collapses >= latest.collapses && level.deleted >= latest.deleted &&
                                 level.collapses <= history.last.collapses.size() &&
                                 level.deleted <= history.last.deleted_faces.size();
        if (!is_monotone)
            detail::fail_history(detail::numbered(i),
                                 "must not end before the previous level or after the last level");
        latest = detail::length_at_level(history, static_cast<std::size_t>(i));
        validate(truncate_to_level(history, static_cast<std::size_t>(i)));
    }
    return history;
}

FAQEM_NAMESPACE_END
