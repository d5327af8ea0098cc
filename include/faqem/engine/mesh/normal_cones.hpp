#pragma once
/// \file
/// A fast conservative test of whether the face normals at a vertex are close to each other.

#include <unordered_map>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Tests whether no two face normals at a vertex are more than 120 degrees apart. High-valence vertices have a
/// cached cone, so that their faces are not visited for each test. Belongs to one mesh. Not thread-safe.
class NormalCones {
public:
    /// Whether no two face normals at v are more than 120 degrees apart. The test is conservative: it may
    /// return false although none are. O(1) if all normals are within about 30 degrees, otherwise
    /// O(valence); O(1) on average for high-valence vertices.
    /// \param mesh  the mesh of all earlier calls
    /// \param v     vertex slot
    bool is_narrow(const CollapseMesh& mesh, Index v) {
        // The sum of two unit normals more than 120 degrees apart is shorter than 1, so that the sum of all
        // normals is shorter than their number minus 1.
        const double square = mesh.normal_sum(v).squaredNorm();
        const double max_length = static_cast<double>(mesh.degree(v)) - 1 + 1e-6;
        if (mesh.degree(v) > 0 && square > max_length * max_length) return true;
        return mesh.is_high_valence(v) ? has_narrow_cached_cone(mesh, v)
                                       : has_normals_within_one_cone(mesh, v);
    }

    /// Updates the cached cones after a collapse. O(1) if none is cached, otherwise O(valence)
    /// \param survivor  the vertex that remains; its faces may have new normals
    void after_collapse(const CollapseMesh& mesh, Index survivor) {
        if (cones_.empty()) return;
        cones_.erase(survivor);
        mesh.for_each_face(survivor, [&](Index f, unsigned) {
            for (const Index v : mesh.triangle(f))
                if (const auto known = cones_.find(v); known != cones_.end() && known->second.is_narrow)
                    known->second.is_narrow = is_within_60_degrees(known->second.axis, mesh.normal(f));
        });
    }

private:
    struct Cone {
        bool is_narrow = false;  ///< all normals are within 60 degrees of `axis`
        Vector3 axis = Vector3::Zero();
        Index outside_face = no_index;  ///< a face whose normal was outside the cone
    };

    // Normals within 60 degrees of one direction are at most 120 degrees apart.
    static bool has_normals_within_one_cone(const CollapseMesh& mesh, Index v) {
        const Vector3& axis = mesh.normal_sum(v);
        return mesh.all_of_faces(
            v, [&](Index f, unsigned) { return is_within_60_degrees(axis, mesh.normal(f)); });
    }

    static bool is_within_60_degrees(const Vector3& direction, const Vector3& normal) {
        const double along = normal.dot(direction);
        return along > 0 && along * along > 0.25 * direction.squaredNorm();
    }

    // after_collapse() compares new normals with the axis cached here, so that the others need not be visited
    // while all of them are inside the cone. A face that was outside is tested first.
    bool has_narrow_cached_cone(const CollapseMesh& mesh, Index v) {
        Cone& cone = cones_[v];
        if (cone.is_narrow) return true;
        const Vector3& axis = mesh.normal_sum(v);
        const Index f = cone.outside_face;
        if (f != no_index && mesh.has_corner(f, v) && !is_within_60_degrees(axis, mesh.normal(f)))
            return false;
        cone = {true, axis, no_index};
        mesh.all_of_faces(v, [&](Index g, unsigned) {
            cone.is_narrow = is_within_60_degrees(axis, mesh.normal(g));
            if (!cone.is_narrow) cone.outside_face = g;
            return cone.is_narrow;
        });
        return cone.is_narrow;
    }

    // Per high-valence vertex that was tested. Never iterated, so that the order of the hash does not matter.
    std::unordered_map<Index, Cone> cones_;
};

FAQEM_ENGINE_END
