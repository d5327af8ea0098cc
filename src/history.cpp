#include "faqem/history.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <istream>
#include <ostream>
#include <string>

#include "edge_swap.hpp"
#include "faqem/error.hpp"
#include "final_versions.hpp"

namespace faqem {

namespace {

static_assert(std::endian::native == std::endian::little, "the history format is written byte for byte");
static_assert(sizeof(Vec3) == 24 && sizeof(Triangle) == 12);

constexpr std::array<char, 8> magic = {'F', 'A', 'Q', 'E', 'M', 'H', '0', '3'};

[[noreturn]] void fail(const std::string& section, const std::string& what) {
    throw InputError("history", section, what);
}

template <class T>
void put(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
void put_array(std::ostream& out, const std::vector<T>& values) {
    put(out, static_cast<std::uint64_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}

void get_bytes(std::istream& in, void* to, std::size_t size, const char* section) {
    in.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
    if (static_cast<std::size_t>(in.gcount()) != size) fail(section, "ends too early");
}

// Reads in pieces, so that a count that lies costs no more memory than the bytes that follow.
template <class T>
std::vector<T> get_array(std::istream& in, const char* section) {
    constexpr std::uint64_t piece = (1u << 20) / sizeof(T);
    std::uint64_t count = 0;
    get_bytes(in, &count, sizeof count, section);
    std::vector<T> values;
    while (values.size() < count) {
        const std::size_t begin = values.size();
        const std::size_t size = static_cast<std::size_t>(std::min(piece, count - begin));
        values.resize(begin + size);
        get_bytes(in, values.data() + begin, size * sizeof(T), section);
    }
    return values;
}

// Collapses and deletions are written as parallel arrays: their structs have padding.
template <class T, class Member>
auto column(const std::vector<T>& rows, Member member) {
    std::vector<std::decay_t<decltype(rows.front().*member)>> values;
    values.reserve(rows.size());
    for (const T& row : rows) values.push_back(row.*member);
    return values;
}

template <class T, class Value>
void fill_column(std::vector<T>& rows, Value T::*member, const std::vector<Value>& values,
                 const char* section) {
    if (rows.size() != values.size()) fail(section, "columns of different length");
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = values[i];
}

std::string numbered(const char* what, std::size_t i) {
    return std::string(what) + "[" + std::to_string(i) + "]";
}

void check_faces(const CollapseHistory& h) {
    for (std::size_t f = 0; f < h.triangles.size(); ++f) {
        const Triangle& t = h.triangles[f];
        const bool dropped = t[0] == no_index && t[1] == no_index && t[2] == no_index;
        const bool inside =
            t[0] < h.positions.size() && t[1] < h.positions.size() && t[2] < h.positions.size();
        if (!dropped && !inside) fail(numbered("triangles", f), "vertex index out of range");
    }
    if (!h.face_groups.empty() && h.face_groups.size() != h.triangles.size()) {
        fail("face_groups", "needs one entry per face or none");
    }
}

// Marks the versions that collapses use up; each is used once, after it was made.
std::vector<std::uint8_t> check_collapses(const CollapseHistory& h) {
    const std::size_t versions = h.positions.size() + h.collapses.size();
    if (versions >= no_index) fail("collapses", "too many");
    std::vector<std::uint8_t> used(versions, 0);
    for (std::size_t k = 0; k < h.collapses.size(); ++k) {
        const Collapse& c = h.collapses[k];
        for (const Index v : {c.first, c.second}) {
            if (!(v < h.positions.size() + k)) fail(numbered("collapses", k), "version not made yet");
            if (used[v]) fail(numbered("collapses", k), "version collapsed twice");
            used[v] = 1;
        }
    }
    return used;
}

void check_patches(const CollapseHistory& h) {
    if (h.patch_begin.size() <= h.collapses.size() || h.patch_begin.front() != 0 ||
        h.patch_begin.back() != h.patch_faces.size() ||
        !std::is_sorted(h.patch_begin.begin(), h.patch_begin.end())) {
        fail("patch_begin", "must rise from 0 to the number of patch faces");
    }
    for (std::size_t k = h.collapses.size(); k < h.patch_count(); ++k) {
        if (h.patch(k).size() != 2) fail(numbered("patch_begin", k), "a swap has two faces");
    }
    for (std::size_t i = 0; i < h.patch_faces.size(); ++i) {
        const Index f = h.patch_faces[i];
        if (!(f < h.triangles.size()) || h.triangles[f][0] == no_index) {
            fail(numbered("patch_faces", i), "no such face");
        }
    }
    for (std::size_t i = 0; i < h.deleted_faces.size(); ++i) {
        if (!(h.deleted_faces[i].face < h.triangles.size()) ||
            !(h.deleted_faces[i].time <= h.collapses.size())) {
            fail(numbered("deleted_faces", i), "out of range");
        }
    }
}

// Vertex of the small mesh for each version that is kept.
std::vector<Index> kept_vertex(const CollapseHistory& h) {
    std::vector<Index> vertex(h.positions.size() + h.collapses.size(), no_index);
    for (std::size_t i = 0; i < h.kept_versions.size(); ++i)
        vertex[h.kept_versions[i]] = static_cast<Index>(i);
    return vertex;
}

// All faces over the vertices of the small mesh after the last swap; what was not kept has no_index corners.
std::vector<Triangle> small_faces(const CollapseHistory& h) {
    const std::vector<Index> vertex = kept_vertex(h);
    const std::vector<Index> last = detail::final_versions(h);
    std::vector<Triangle> faces(h.triangles.size(), {no_index, no_index, no_index});
    for (std::size_t i = 0; i < h.kept_faces.size(); ++i) {
        const Index f = h.kept_faces[i];
        const Triangle& t = h.triangles[f];
        faces[f] = {vertex[last[t[0]]], vertex[last[t[1]]], vertex[last[t[2]]]};
        for (const Index v : faces[f]) {
            if (v == no_index) fail(numbered("kept_faces", i), "has a vertex that was not kept");
        }
    }
    for (std::size_t k = h.collapses.size(); k < h.patch_count(); ++k) {
        Triangle &s = faces[h.patch(k)[0]], &t = faces[h.patch(k)[1]];
        if (s[0] == no_index || t[0] == no_index || !detail::swap_edge(s, t))
            fail(numbered("patch_begin", k), "a swap of faces that share no edge");
    }
    return faces;
}

void check_kept(const CollapseHistory& h, const std::vector<std::uint8_t>& used) {
    for (std::size_t i = 0; i < h.kept_versions.size(); ++i) {
        const Index v = h.kept_versions[i];
        if (!(v < used.size()) || used[v]) fail(numbered("kept_versions", i), "not a living version");
    }
    if (!h.kept_positions.empty() && h.kept_positions.size() != h.kept_versions.size()) {
        fail("kept_positions", "needs one entry per kept version or none");
    }
    for (std::size_t i = 0; i < h.kept_faces.size(); ++i) {
        const Index f = h.kept_faces[i];
        if (!(f < h.triangles.size()) || h.triangles[f][0] == no_index)
            fail(numbered("kept_faces", i), "no such face");
    }
    small_faces(h);
}

}  // namespace

void validate(const CollapseHistory& history) {
    const CollapseHistory& h = history;
    const bool nothing = h.positions.empty() && h.triangles.empty() && h.face_groups.empty() &&
                         h.collapses.empty() && h.patch_begin.empty() && h.patch_faces.empty() &&
                         h.deleted_faces.empty() && h.kept_versions.empty() && h.kept_faces.empty() &&
                         h.kept_positions.empty();
    if (nothing) return;
    check_faces(history);
    const std::vector<std::uint8_t> used = check_collapses(history);
    check_patches(history);
    check_kept(history, used);
}

TriangleMesh replay(const CollapseHistory& history) {
    TriangleMesh mesh;
    for (std::size_t i = 0; i < history.kept_versions.size(); ++i) {
        mesh.positions.push_back(history.kept_position(i));
    }
    const std::vector<Triangle> faces = small_faces(history);
    for (const Index f : history.kept_faces) {
        mesh.triangles.push_back(faces[f]);
        if (!history.face_groups.empty()) mesh.face_groups.push_back(history.face_groups[f]);
    }
    return mesh;
}

void write(const CollapseHistory& h, std::ostream& out) {
    out.write(magic.data(), magic.size());
    put_array(out, h.positions);
    put_array(out, h.triangles);
    put_array(out, h.face_groups);
    put_array(out, column(h.collapses, &Collapse::first));
    put_array(out, column(h.collapses, &Collapse::second));
    put_array(out, column(h.collapses, &Collapse::position));
    put_array(out, h.patch_begin);
    put_array(out, h.patch_faces);
    put_array(out, h.kept_positions);
    put_array(out, column(h.deleted_faces, &DeletedFace::time));
    put_array(out, column(h.deleted_faces, &DeletedFace::face));
    put_array(out, h.kept_versions);
    put_array(out, h.kept_faces);
    out.flush();
    if (!out) throw WriteError("the history could not be written");
}

CollapseHistory read_history(std::istream& in) {
    std::array<char, 8> found = {};
    get_bytes(in, found.data(), found.size(), "header");
    if (found != magic) fail("header", "not a collapse history of this version");
    CollapseHistory h;
    h.positions = get_array<Vec3>(in, "positions");
    h.triangles = get_array<Triangle>(in, "triangles");
    h.face_groups = get_array<Index>(in, "face_groups");
    const auto firsts = get_array<Index>(in, "collapses");
    h.collapses.resize(firsts.size());
    fill_column(h.collapses, &Collapse::first, firsts, "collapses");
    fill_column(h.collapses, &Collapse::second, get_array<Index>(in, "collapses"), "collapses");
    fill_column(h.collapses, &Collapse::position, get_array<Vec3>(in, "collapses"), "collapses");
    h.patch_begin = get_array<std::uint64_t>(in, "patch_begin");
    h.patch_faces = get_array<Index>(in, "patch_faces");
    h.kept_positions = get_array<Vec3>(in, "kept_positions");
    const auto times = get_array<std::uint64_t>(in, "deleted_faces");
    h.deleted_faces.resize(times.size());
    fill_column(h.deleted_faces, &DeletedFace::time, times, "deleted_faces");
    fill_column(h.deleted_faces, &DeletedFace::face, get_array<Index>(in, "deleted_faces"), "deleted_faces");
    h.kept_versions = get_array<Index>(in, "kept_versions");
    h.kept_faces = get_array<Index>(in, "kept_faces");
    validate(h);
    return h;
}

}  // namespace faqem
