#pragma once
/// \file
/// The surface as the engine sees it: any triangle soup, edges with three faces and more included.

#include <array>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// 6 * max_faces < 2^32: a soup has up to three edges per face, and a pair two ends.
inline constexpr std::size_t max_faces = 715'827'880;

/// Vertices, triangles with their normals, and for each vertex a list of its corners. Faces keep their index
/// for life.
///
/// Lists are cleaned lazily: a corner of a dead face stays in the list of a vertex until that vertex survives
/// a collapse, so that removing a face next to a vertex of valence n costs O(1), not O(n). At most max_faces
/// faces: corners and pairs are numbered in 32 bits.
class CollapseMesh {
public:
    /// \param positions  one per vertex
    /// \param triangles  indices into positions; a face with no_index corners is dead from the start
    /// \throws what the poll throws
    CollapseMesh(const std::vector<Vector3>& positions, const std::vector<Triangle>& triangles,
                 CancellationCheck check_cancelled = {}) {
        vertices_.reserve(positions.size());
        for (const Vector3& p : positions) vertices_.push_back({p, Vector3::Zero(), {}, 0, no_index});
        faces_.resize(triangles.size());
        for (Index f = 0; f < faces_.size(); ++f) {
            check_cancelled();
            faces_[f].corners = triangles[f];
            if (!is_alive(f)) continue;
            ++face_count_;
            for (const Index v : triangles[f]) ++vertices_[v].degree;
        }
        corners_.reserve(3 * face_count_, vertices_.size());
        for (Vertex& vertex : vertices_) {
            check_cancelled();
            if (vertex.degree > 0) vertex.corners = corners_.allocate(vertex.degree);
        }
        for (Index f = 0; f < faces_.size(); ++f) {
            check_cancelled();
            if (!is_alive(f)) continue;
            for (Index k = 0; k < 3; ++k) corners_.push_back(vertices_[triangles[f][k]].corners, 4 * f + k);
            set_normal(f);
        }
    }

    std::size_t vertex_slots() const { return vertices_.size(); }
    std::size_t face_slots() const { return faces_.size(); }
    /// Faces that are alive.
    std::size_t face_count() const { return face_count_; }

    const Vector3& position(Index v) const { return vertices_[v].position; }
    const Triangle& triangle(Index f) const { return faces_[f].corners; }
    bool is_alive(Index f) const { return faces_[f].corners[0] != no_index; }
    /// Number of living faces at v.
    std::uint32_t degree(Index v) const { return vertices_[v].degree; }
    /// Has it so many faces that they cannot all be looked at for each collapse beside it?
    bool is_high_valence(Index v) const { return degree(v) > 256; }

    /// Both, the one with fewer faces first: what is asked of their edge is found sooner there, above all if
    /// the other one is a hub.
    std::pair<Index, Index> lower_degree_first(Index a, Index b) const {
        return degree(b) < degree(a) ? std::pair(b, a) : std::pair(a, b);
    }

    /// Calls visit(face, corner) for every living face at v; corner is 0, 1 or 2.
    template <class Visit>
    void for_each_face(Index v, Visit&& visit) const {
        for (const Index c : corners_[vertices_[v].corners]) {
            const Index f = c / 4;
            if (is_alive(f)) visit(f, c % 4);
        }
    }

    /// Calls visit(face, corner) until it returns false; tells whether it never did.
    template <class Visit>
    bool all_of_faces(Index v, Visit&& visit) const {
        for (const Index c : corners_[vertices_[v].corners]) {
            const Index f = c / 4;
            if (is_alive(f) && !visit(f, c % 4)) return false;
        }
        return true;
    }

    /// Calls visit(face, corner) for every living face at u, then for every one at v that is not at u; corner
    /// is that of u or v.
    template <class Visit>
    void for_each_face_around(Index u, Index v, Visit&& visit) const {
        for_each_face(u, visit);
        for_each_face(v, [&](Index f, unsigned corner) {
            if (!has_corner(f, u)) visit(f, corner);
        });
    }

    bool has_corner(Index f, Index v) const {
        const Triangle& t = triangle(f);
        return t[0] == v || t[1] == v || t[2] == v;
    }

    /// Does f go along its edge from a to b, not from b to a? Faces of one winding disagree about it.
    bool has_directed_edge(Index f, Index a, Index b) const {
        const Triangle& t = triangle(f);
        return t[0] == a ? t[1] == b : t[1] == a ? t[2] == b : t[2] == a && t[0] == b;
    }

    /// Twice the area of f, along its normal.
    Vector3 area_vector(Index f) const {
        const Triangle& t = triangle(f);
        return engine::area_vector(position(t[0]), position(t[1]), position(t[2]));
    }

    /// Unit normal of f; zero where it has no area.
    const Vector3& normal(Index f) const { return faces_[f].normal; }
    double area(Index f) const { return faces_[f].area; }

    /// Are all normals at v at most 120 degrees apart? May be false where they are. O(1) where they are
    /// within about 30 degrees, else O(valence); at hubs that has to be found out rarely
    bool has_narrow_normal_cone(Index v) const {
        const Vertex& vertex = vertices_[v];
        // The sum of two at more than 120 degrees is no longer than 1, and that of all than one less than
        // there are.
        const double square = vertex.normals.squaredNorm();
        const double max_length = static_cast<double>(vertex.degree) - 1 + 1e-6;
        if (vertex.degree > 0 && square > max_length * max_length) return true;
        return is_high_valence(v) ? has_narrow_cached_cone(v) : has_normals_within_one_cone(v);
    }

    /// Number of faces with the corners a, b and c. O(the smallest of their valences)
    std::uint32_t count_faces_with(Index a, Index b, Index c) const {
        std::uint32_t count = 0;
        if (degree(b) < degree(a)) std::swap(a, b);
        if (degree(c) < degree(a)) std::swap(a, c);
        for_each_face(a, [&](Index f, unsigned) { count += has_corner(f, b) && has_corner(f, c); });
        return count;
    }

    /// Area of all faces. O(faces)
    double area() const {
        double sum = 0;
        for (Index f = 0; f < face_slots(); ++f) {
            if (is_alive(f)) sum += area(f);
        }
        return sum;
    }

    /// Moves `survivor` to `p` and gives it the faces of `gone`; faces with both vanish.
    /// \return number of faces that vanished
    std::size_t collapse(Index survivor, Index removed, const Vector3& p) {
        assert(survivor != removed);
        const std::size_t before = face_count_;
        Vertex &to = vertices_[survivor], &from = vertices_[removed];
        for_each_face(removed, [&](Index f, unsigned) {
            if (has_corner(f, survivor)) remove_face(f);
        });
        kept_.clear();
        const auto keep = [&](Index f, unsigned corner) {
            Face& face = faces_[f];
            face.corners[corner] = survivor;
            vertices_[face.corners[(corner + 1) % 3]].normals -= face.normal;
            vertices_[face.corners[(corner + 2) % 3]].normals -= face.normal;
            kept_.push_back(4 * f + corner);
        };
        for_each_face(survivor, keep);
        for_each_face(removed, keep);
        corners_.assign(to.corners, kept_);
        if (to.cone != no_index) normal_cones_[to.cone] = {};
        to.position = p;
        to.normals = Vector3::Zero();
        to.degree += from.degree;
        from.corners.size = from.degree = 0;
        for_each_face(survivor, [&](Index f, unsigned) { set_normal(f); });
        return before - face_count_;
    }

    /// Removes a living face.
    void remove_face(Index f) {
        add_normal(f, -1);
        for (const Index v : faces_[f].corners) --vertices_[v].degree;
        faces_[f].corners = {no_index, no_index, no_index};
        --face_count_;
    }

private:
    // What is known of the normals at a hub.
    struct NormalCone {
        bool is_narrow = false;  ///< all of them are within 60 degrees of `about`
        Vector3 axis = Vector3::Zero();
        Index outside_face = no_index;  ///< a face whose one was not
    };
    // Normals that are all within 60 degrees of one direction are no more than 120 degrees apart.
    bool has_normals_within_one_cone(Index v) const {
        const Vector3& axis = vertices_[v].normals;
        return all_of_faces(v, [&](Index f, unsigned) { return is_within_60_degrees(axis, normal(f)); });
    }

    static bool is_within_60_degrees(const Vector3& direction, const Vector3& normal) {
        const double along = normal.dot(direction);
        return along > 0 && along * along > 0.25 * direction.squaredNorm();
    }

    // New normals are compared with the direction found here, so that as long as they keep to it the others
    // need not be looked at again. A face that was to blame once is asked first.
    bool has_narrow_cached_cone(Index v) const {
        const Vertex& vertex = vertices_[v];
        if (vertex.cone == no_index) {
            vertex.cone = static_cast<Index>(normal_cones_.size());
            normal_cones_.emplace_back();
        }
        NormalCone& cone = normal_cones_[vertex.cone];
        if (cone.is_narrow) return true;
        const Index f = cone.outside_face;
        if (f != no_index && has_corner(f, v) && !is_within_60_degrees(vertex.normals, normal(f)))
            return false;
        cone = {true, vertex.normals, no_index};
        all_of_faces(v, [&](Index g, unsigned) {
            cone.is_narrow = is_within_60_degrees(vertex.normals, normal(g));
            if (!cone.is_narrow) cone.outside_face = g;
            return cone.is_narrow;
        });
        return cone.is_narrow;
    }

    // What is needed together lies together: a vertex is a cache line.
    struct alignas(64) Vertex {
        Vector3 position;
        Vector3 normals;    ///< sum of those of its faces
        IndexList corners;  ///< 4 * face + (0, 1 or 2); some faces have died since
        std::uint32_t degree;
        mutable Index cone = no_index;  ///< its place in normal_cones_, where it has one
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
        for (const Index v : face.corners) {
            if (vertices_[v].cone == no_index) continue;
            NormalCone& cone = normal_cones_[vertices_[v].cone];
            if (cone.is_narrow) cone.is_narrow = is_within_60_degrees(cone.axis, face.normal);
        }
    }

    void add_normal(Index f, double sign) {
        for (const Index v : faces_[f].corners) vertices_[v].normals += sign * faces_[f].normal;
    }

    std::vector<Vertex> vertices_;
    std::vector<Face> faces_;
    mutable std::vector<NormalCone> normal_cones_;  // found out where it is asked for
    std::size_t face_count_ = 0;
    IndexLists corners_;
    std::vector<Index> kept_;  // scratch: corners of the survivor
};

}  // namespace engine
FAQEM_NAMESPACE_END
