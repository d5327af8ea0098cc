#pragma once
/// \file
/// The mesh that the engine collapses: any triangle soup, including edges with three or more faces.

#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_ENGINE_BEGIN

/// Largest number of faces of a CollapseMesh. A soup has up to three edges per face and a pair has two
/// ends, so that 6 * max_faces < 2^32 ends can be numbered in 32 bits.
inline constexpr std::size_t max_faces = 715'827'880;

/// Triangle mesh with one list of corners per vertex. Vertices and faces are identified by slots, whose
/// numbers never change; a removed face keeps its slot and is no longer alive.
///
/// Lists are cleaned up lazily: the corner of a removed face stays in the list of a vertex until that
/// vertex survives a collapse, so that removing a face at a vertex of valence n takes O(1), not O(n).
/// Const functions may run on several threads at once.
class CollapseMesh {
public:
    /// Builds the mesh. O(vertices + faces)
    /// \param positions  one per vertex slot, engine units
    /// \param triangles  one per face slot: indices into `positions`, pairwise different, or three times
    ///     no_index for a face that is not alive. At most max_faces
    CollapseMesh(const std::vector<Vector3>& positions, const std::vector<Triangle>& triangles) {
        vertices_.reserve(positions.size());
        for (const Vector3& p : positions) vertices_.push_back({p, Vector3::Zero(), {}, 0});
        faces_.resize(triangles.size());
        for (Index f = 0; f < faces_.size(); ++f) {
            faces_[f].corners = triangles[f];
            if (!is_alive(f)) continue;
            ++face_count_;
            for (const Index v : triangles[f]) ++vertices_[v].degree;
        }
        corners_.reserve(3 * face_count_, vertices_.size());
        for (Vertex& vertex : vertices_)
            if (vertex.degree > 0) vertex.corners = corners_.allocate(vertex.degree);
        for (Index f = 0; f < faces_.size(); ++f) {
            if (!is_alive(f)) continue;
            for (Index k = 0; k < 3; ++k) corners_.push_back(vertices_[triangles[f][k]].corners, 4 * f + k);
            set_normal(f);
        }
    }

    /// Number of vertex slots, including vertices without faces.
    std::size_t vertex_slots() const { return vertices_.size(); }
    /// Number of face slots, including removed faces.
    std::size_t face_slots() const { return faces_.size(); }
    /// Number of faces that are alive.
    std::size_t face_count() const { return face_count_; }

    /// Position of vertex v, engine units.
    const Vector3& position(Index v) const { return vertices_[v].position; }
    /// Vertices of face f; three times no_index if it was removed.
    const Triangle& triangle(Index f) const { return faces_[f].corners; }
    /// Whether face f has not been removed.
    bool is_alive(Index f) const { return faces_[f].corners[0] != no_index; }
    /// Number of faces at v. Removed faces do not count.
    std::uint32_t degree(Index v) const { return vertices_[v].degree; }
    /// Whether v has more than 256 faces, too many to visit all of them for each collapse nearby.
    bool is_high_valence(Index v) const { return degree(v) > 256; }

    /// Both vertices, the one with fewer faces first. A search for the faces of their edge is fastest among
    /// the faces of the first one, in particular if the other one has a high valence.
    std::pair<Index, Index> lower_degree_first(Index a, Index b) const {
        return degree(b) < degree(a) ? std::pair(b, a) : std::pair(a, b);
    }

    /// Calls visit(face, corner) for every face at v. O(valence)
    /// \param visit  `corner` is the position of v in triangle(face): 0, 1 or 2
    template <class Visit>
    void for_each_face(Index v, Visit&& visit) const {
        for (const Index c : corners_[vertices_[v].corners]) {
            const Index f = c / 4;
            if (is_alive(f)) visit(f, c % 4);
        }
    }

    /// Calls visit(face, corner) for the faces at v until it returns false. Returns whether it never did.
    /// O(valence)
    template <class Visit>
    bool all_of_faces(Index v, Visit&& visit) const {
        for (const Index c : corners_[vertices_[v].corners]) {
            const Index f = c / 4;
            if (is_alive(f) && !visit(f, c % 4)) return false;
        }
        return true;
    }

    /// Calls visit(face) for every face at both u and v. O(smaller valence)
    template <class Visit>
    void for_each_face_between(Index u, Index v, Visit&& visit) const {
        // Not a structured binding, which clang 14 cannot capture in a lambda.
        const std::pair<Index, Index> ends = lower_degree_first(u, v);
        for_each_face(ends.first, [&](Index f, unsigned) {
            if (has_corner(f, ends.second)) visit(f);
        });
    }

    /// Calls visit(face, corner) once for every face at u or v: first for the faces at u, with the corner
    /// of u, then for the others, with the corner of v. O(valence)
    template <class Visit>
    void for_each_face_around(Index u, Index v, Visit&& visit) const {
        for_each_face(u, visit);
        for_each_face(v, [&](Index f, unsigned corner) {
            if (!has_corner(f, u)) visit(f, corner);
        });
    }

    /// Whether v is a vertex of f. O(1)
    bool has_corner(Index f, Index v) const {
        const Triangle& t = triangle(f);
        return t[0] == v || t[1] == v || t[2] == v;
    }

    /// Whether the winding of f passes its edge from a to b, rather than from b to a. For two faces of the
    /// same orientation exactly one of them does. O(1)
    bool has_directed_edge(Index f, Index a, Index b) const {
        const Triangle& t = triangle(f);
        return t[0] == a ? t[1] == b : t[1] == a ? t[2] == b : t[2] == a && t[0] == b;
    }

    /// Area vector of f: its unit normal times twice its area.
    Vector3 area_vector(Index f) const {
        const Triangle& t = triangle(f);
        return engine::area_vector(position(t[0]), position(t[1]), position(t[2]));
    }

    /// Unit normal of f; zero if f has no area.
    const Vector3& normal(Index f) const { return faces_[f].normal; }
    /// Area of f.
    double area(Index f) const { return faces_[f].area; }

    /// Sum of the unit normals of the faces at v.
    const Vector3& normal_sum(Index v) const { return vertices_[v].normals; }

    /// Number of faces with the vertices a, b and c, in any winding. O(smallest valence of the three)
    std::uint32_t count_faces_with(Index a, Index b, Index c) const {
        std::uint32_t count = 0;
        if (degree(b) < degree(a)) std::swap(a, b);
        if (degree(c) < degree(a)) std::swap(a, c);
        for_each_face(a, [&](Index f, unsigned) { count += has_corner(f, b) && has_corner(f, c); });
        return count;
    }

    /// Total area of the faces. O(face slots)
    double area() const {
        double sum = 0;
        for (Index f = 0; f < face_slots(); ++f)
            if (is_alive(f)) sum += area(f);
        return sum;
    }

    /// Collapses a pair: moves `survivor` to `p` and attaches the faces of `removed` to it. Faces with both
    /// vertices are removed. Legality is not checked. O(valence)
    /// \param survivor, removed  different vertices
    /// \param p                  new position, engine units
    /// \return number of removed faces
    std::size_t collapse(Index survivor, Index removed, const Vector3& p) {
        assert(survivor != removed);
        const std::size_t before = face_count_;
        Vertex &to = vertices_[survivor], &from = vertices_[removed];
        for_each_face(removed, [&](Index f, unsigned) {
            if (has_corner(f, survivor)) remove_face(f);
        });
        remaining_.clear();
        const auto keep = [&](Index f, unsigned corner) {
            Face& face = faces_[f];
            face.corners[corner] = survivor;
            vertices_[face.corners[(corner + 1) % 3]].normals -= face.normal;
            vertices_[face.corners[(corner + 2) % 3]].normals -= face.normal;
            remaining_.push_back(4 * f + corner);
        };
        for_each_face(survivor, keep);
        for_each_face(removed, keep);
        corners_.assign(to.corners, remaining_);
        to.position = p;
        to.normals = Vector3::Zero();
        to.degree += from.degree;
        from.corners.size = from.degree = 0;
        for_each_face(survivor, [&](Index f, unsigned) { set_normal(f); });
        return before - face_count_;
    }

    /// Removes face f. O(1)
    /// \pre is_alive(f)
    void remove_face(Index f) {
        add_normal(f, -1);
        for (const Index v : faces_[f].corners) --vertices_[v].degree;
        faces_[f].corners = {no_index, no_index, no_index};
        --face_count_;
    }

private:
    // Data that is used together, in one cache line.
    struct alignas(64) Vertex {
        Vector3 position;
        Vector3 normals;    ///< sum of the unit normals of the faces
        IndexList corners;  ///< 4 * face + (0, 1 or 2); includes removed faces
        std::uint32_t degree;
    };
    struct Face {
        Triangle corners;
        Vector3 normal;
        double area;
    };

    void set_normal(Index f) {
        Face& face = faces_[f];
        face.normal = area_vector(f);
        const double length = face.normal.norm();
        face.area = length > 0 ? 0.5 * length : 0;
        face.normal = length > 0 ? Vector3(face.normal / length) : Vector3::Zero();
        add_normal(f, 1);
    }

    void add_normal(Index f, double sign) {
        for (const Index v : faces_[f].corners) vertices_[v].normals += sign * faces_[f].normal;
    }

    std::vector<Vertex> vertices_;
    std::vector<Face> faces_;
    std::size_t face_count_ = 0;
    IndexLists corners_;
    std::vector<Index> remaining_;  // scratch: corners of the survivor
};

FAQEM_ENGINE_END
