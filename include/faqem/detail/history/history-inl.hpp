#pragma once

#include "faqem/history.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/history/binary_io.hpp"
#include "faqem/detail/history/final_versions.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

// One member of all rows. Structs are written as parallel arrays, because they have padding.
template <class T, class Member>
auto column(const std::vector<T>& rows, Member member) {
    std::vector<std::decay_t<decltype(rows.front().*member)>> values;
    values.reserve(rows.size());
    for (const T& row : rows) values.push_back(row.*member);
    return values;
}

// Reads one member of all rows; the inverse of column(). The first member determines the number of rows.
template <class T, class Value>
void get_column(std::istream& in, const char* section, std::vector<T>& rows, Value T::*member,
                bool is_first) {
    const std::vector<Value> values = get_array<Value>(in, section);
    if (is_first) rows.resize(values.size());
    if (rows.size() != values.size()) detail::fail_history(section, "arrays have different lengths");
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = values[i];
}

// Calls visit(name, array) for the sections of the format in their order; for one of structs
// visit(name, rows, members...).
template <class History, class Visit>
void visit_sections(History& h, const Visit& visit) {
    visit("positions", h.positions);
    visit("triangles", h.triangles);
    visit("face_groups", h.face_groups);
    visit("collapses", h.collapses, &Collapse::first, &Collapse::second, &Collapse::position);
    visit("patch_begin", h.patch_begin);
    visit("patch_faces", h.patch_faces);
    visit("final_positions", h.final_positions);
    visit("deleted_faces", h.deleted_faces, &DeletedFace::time, &DeletedFace::face);
    visit("remaining_versions", h.remaining_versions);
    visit("remaining_faces", h.remaining_faces);
}

inline std::string numbered(const char* what, std::size_t i) {
    return std::string(what) + "[" + std::to_string(i) + "]";
}

inline void check_position(const Vec3& position, const char* section, std::size_t i) {
    for (const double x : position)
        if (!std::isfinite(x)) detail::fail_history(numbered(section, i), "position is not finite");
}

inline void check_positions(const CollapseHistory& h) {
    for (std::size_t i = 0; i < h.positions.size(); ++i) check_position(h.positions[i], "positions", i);
    for (std::size_t k = 0; k < h.collapses.size(); ++k)
        check_position(h.collapses[k].position, "collapses", k);
    for (std::size_t i = 0; i < h.final_positions.size(); ++i)
        check_position(h.final_positions[i], "final_positions", i);
}

inline void check_faces(const CollapseHistory& h) {
    for (std::size_t f = 0; f < h.triangles.size(); ++f) {
        const Triangle& t = h.triangles[f];
        const bool dropped = t[0] == no_index && t[1] == no_index && t[2] == no_index;
        const bool inside =
            t[0] < h.positions.size() && t[1] < h.positions.size() && t[2] < h.positions.size();
        if (!dropped && !inside) detail::fail_history(numbered("triangles", f), "vertex index out of range");
    }
    if (!h.face_groups.empty() && h.face_groups.size() != h.triangles.size())
        detail::fail_history("face_groups", "needs one entry per face or none");
}

// Checks that each version is merged at most once and after its creation. Returns 1 for merged versions.
inline std::vector<std::uint8_t> check_collapses(const CollapseHistory& h) {
    const std::size_t versions = h.positions.size() + h.collapses.size();
    if (versions >= no_index) detail::fail_history("collapses", "too many for 32-bit version indices");
    std::vector<std::uint8_t> used(versions, 0);
    for (std::size_t k = 0; k < h.collapses.size(); ++k) {
        const Collapse& c = h.collapses[k];
        for (const Index v : {c.first, c.second}) {
            if (!(v < h.positions.size() + k))
                detail::fail_history(numbered("collapses", k), "version does not exist yet");
            if (used[v]) detail::fail_history(numbered("collapses", k), "version was already merged");
            used[v] = 1;
        }
    }
    return used;
}

inline void check_faces_exist(const CollapseHistory& h, const std::vector<Index>& faces,
                              const char* section) {
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (!(faces[i] < h.triangles.size()) || h.triangles[faces[i]][0] == no_index)
            detail::fail_history(numbered(section, i), "face does not exist");
}

inline void check_patches(const CollapseHistory& h) {
    if (h.patch_begin.size() <= h.collapses.size() || h.patch_begin.front() != 0 ||
        h.patch_begin.back() != h.patch_faces.size() ||
        !std::is_sorted(h.patch_begin.begin(), h.patch_begin.end()))
        detail::fail_history("patch_begin", "must increase from 0 to the number of patch faces");
    for (std::size_t k = h.collapses.size(); k < h.patch_count(); ++k)
        if (h.patch(k).size() != 2)
            detail::fail_history(numbered("patch_begin", k), "an edge flip must have two faces");
    check_faces_exist(h, h.patch_faces, "patch_faces");
    for (std::size_t i = 0; i < h.deleted_faces.size(); ++i) {
        if (!(h.deleted_faces[i].face < h.triangles.size()) ||
            !(h.deleted_faces[i].time <= h.collapses.size()))
            detail::fail_history(numbered("deleted_faces", i), "time or face index out of range");
    }
}

// For each version, its vertex in the simplified mesh, or no_index.
inline std::vector<Index> simplified_vertex(const CollapseHistory& h) {
    std::vector<Index> vertex(h.positions.size() + h.collapses.size(), no_index);
    for (std::size_t i = 0; i < h.remaining_versions.size(); ++i)
        vertex[h.remaining_versions[i]] = static_cast<Index>(i);
    return vertex;
}

// For each input face, its vertices in the simplified mesh after the last edge flip, or no_index.
inline std::vector<Triangle> simplified_faces(const CollapseHistory& h) {
    const std::vector<Index> vertex = simplified_vertex(h);
    const std::vector<Index> last = detail::final_versions(h);
    std::vector<Triangle> faces(h.triangles.size(), {no_index, no_index, no_index});
    for (std::size_t i = 0; i < h.remaining_faces.size(); ++i) {
        const Index f = h.remaining_faces[i];
        const Triangle& t = h.triangles[f];
        faces[f] = {vertex[last[t[0]]], vertex[last[t[1]]], vertex[last[t[2]]]};
        for (const Index v : faces[f]) {
            if (v == no_index)
                detail::fail_history(numbered("remaining_faces", i),
                                     "refers to a vertex that is not in the simplified mesh");
        }
    }
    for (std::size_t k = h.collapses.size(); k < h.patch_count(); ++k) {
        Triangle &s = faces[h.patch(k)[0]], &t = faces[h.patch(k)[1]];
        if (s[0] == no_index || t[0] == no_index || !detail::flip_edge(s, t))
            detail::fail_history(numbered("patch_begin", k),
                                 "faces of an edge flip must remain and share an edge");
    }
    return faces;
}

inline void check_remaining(const CollapseHistory& h, const std::vector<std::uint8_t>& used) {
    for (std::size_t i = 0; i < h.remaining_versions.size(); ++i) {
        const Index v = h.remaining_versions[i];
        if (!(v < used.size()) || used[v])
            detail::fail_history(numbered("remaining_versions", i), "version does not exist or was merged");
    }
    if (!h.final_positions.empty() && h.final_positions.size() != h.remaining_versions.size())
        detail::fail_history("final_positions", "needs one entry per remaining version or none");
    check_faces_exist(h, h.remaining_faces, "remaining_faces");
    simplified_faces(h);
}

}  // namespace detail

FAQEM_INLINE void validate(const CollapseHistory& history) {
    bool nothing = true;
    detail::visit_sections(
        history, [&](const char*, const auto& rows, auto...) { nothing = nothing && rows.empty(); });
    if (nothing) return;
    detail::check_positions(history);
    detail::check_faces(history);
    const std::vector<std::uint8_t> used = detail::check_collapses(history);
    detail::check_patches(history);
    detail::check_remaining(history, used);
}

FAQEM_INLINE TriangleMesh replay(const CollapseHistory& history) {
    TriangleMesh mesh;
    for (std::size_t i = 0; i < history.remaining_versions.size(); ++i)
        mesh.positions.push_back(history.final_position(i));
    const std::vector<Triangle> faces = detail::simplified_faces(history);
    for (const Index f : history.remaining_faces) {
        mesh.triangles.push_back(faces[f]);
        if (!history.face_groups.empty()) mesh.face_groups.push_back(history.face_groups[f]);
    }
    return mesh;
}

FAQEM_INLINE void write(const CollapseHistory& h, std::ostream& out) {
    detail::put(out, detail::history_magic);
    detail::visit_sections(h, [&](const char*, const auto& rows, auto... members) {
        if constexpr (sizeof...(members) == 0)
            detail::put_array(out, rows);
        else
            (detail::put_array(out, detail::column(rows, members)), ...);
    });
    out.flush();
    if (!out) throw WriteError("cannot write the history");
}

FAQEM_INLINE CollapseHistory read_history(std::istream& in) {
    if (detail::get<detail::HistoryMagic>(in, "header") != detail::history_magic)
        detail::fail_history("header", "not a collapse history, or of an unsupported version");
    return detail::read_history_body(in);
}

FAQEM_INLINE CollapseHistory detail::read_history_body(std::istream& in) {
    CollapseHistory h;
    visit_sections(h, [&](const char* section, auto& rows, auto... members) {
        bool is_first = true;
        if constexpr (sizeof...(members) == 0)
            rows = get_array<typename std::decay_t<decltype(rows)>::value_type>(in, section);
        else
            (get_column(in, section, rows, members, std::exchange(is_first, false)), ...);
    });
    validate(h);
    return h;
}

FAQEM_NAMESPACE_END
