#pragma once
/// \file
/// Connected components of a mesh.

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/degenerate.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A connected component: faces that are connected by shared vertices.
struct Component {
    std::vector<Index> faces;  ///< face slots, ascending
    Eigen::AlignedBox3d box;   ///< bounding box, engine units
};

/// Finds the connected components. O(faces + vertices), plus the sorting of their faces
/// \return the components in the order of their smallest face
inline std::vector<Component> components(const CollapseMesh& mesh) {
    std::vector<Component> found;
    std::vector<std::uint8_t> seen(mesh.face_slots(), 0), is_done(mesh.vertex_slots(), 0);
    std::vector<Index> stack;
    for (Index seed = 0; seed < mesh.face_slots(); ++seed) {
        if (!mesh.is_alive(seed) || seen[seed]) continue;
        Component component;
        seen[seed] = 1;
        stack.push_back(seed);
        while (!stack.empty()) {
            const Index f = stack.back();
            stack.pop_back();
            component.faces.push_back(f);
            for (const Index v : mesh.triangle(f)) {
                if (std::exchange(is_done[v], std::uint8_t{1})) continue;
                component.box.extend(mesh.position(v));
                mesh.for_each_face(v, [&](Index g, unsigned) {
                    if (!seen[g]) seen[g] = 1, stack.push_back(g);
                });
            }
        }
        std::sort(component.faces.begin(), component.faces.end());
        found.push_back(std::move(component));
    }
    return found;
}

/// Upper bounds of the size of a component.
struct ComponentSize {
    double diagonal = std::numeric_limits<double>::infinity();  ///< of the bounding box, engine units
    double area = std::numeric_limits<double>::infinity();      ///< of all faces, engine units squared
};

/// Finds the components that the ladder may delete: those without locked vertices and up to a given size,
/// except for the largest component of the mesh. A component whose faces are all degenerate counts as
/// having size 0. O(faces + vertices), plus sorting
/// \param locked           one per vertex slot; components with a nonzero entry stay
/// \param largest          components that exceed one of both bounds stay
/// \return the components, smallest bounding box diagonal first
inline std::vector<Component> removable_components(const CollapseMesh& mesh,
                                                   std::span<const std::uint8_t> locked,
                                                   const ComponentSize& largest) {
    std::vector<Component> all = components(mesh);
    for (Component& c : all) {
        if (std::all_of(c.faces.begin(), c.faces.end(), [&](Index f) { return is_degenerate(mesh, f); }))
            c.box = Eigen::AlignedBox3d(c.box.min());
    }
    const auto diagonal = [](const Component& c) { return c.box.diagonal().norm(); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Component& a, const Component& b) { return diagonal(a) < diagonal(b); });
    if (!all.empty()) all.pop_back();
    const auto has_locked = [&](Index f) {
        const Triangle& t = mesh.triangle(f);
        return locked[t[0]] || locked[t[1]] || locked[t[2]];
    };
    const auto area = [&](const Component& c) {
        double sum = 0;
        for (const Index f : c.faces) sum += mesh.area(f);
        return sum;
    };
    std::erase_if(all, [&](const Component& c) {
        return !(diagonal(c) <= largest.diagonal) || !(area(c) <= largest.area) ||
               std::any_of(c.faces.begin(), c.faces.end(), has_locked);
    });
    return all;
}

/// Removes the faces of a component and the pairs of its vertices. O(faces)
/// \param killed  receives the removed pairs
inline void remove_component(CollapseMesh& mesh, PairTable& pairs, const Component& component,
                             std::vector<Index>& killed) {
    for (const Index f : component.faces) {
        const Triangle t = mesh.triangle(f);
        mesh.remove_face(f);
        for (const Index v : t)
            if (mesh.degree(v) == 0) pairs.kill_all(v, killed);
    }
}

/// Removes removable_components(), smallest first, until the target is reached.
/// \param recorder  notified before each deletion of a face
/// \param killed    receives the removed pairs
/// \return number of removed components
template <class Recorder>
std::size_t remove_components(CollapseMesh& mesh, PairTable& pairs, std::span<const std::uint8_t> locked,
                              const ComponentSize& largest, std::size_t target_faces, Recorder& recorder,
                              std::vector<Index>& killed) {
    std::size_t removed = 0;
    for (const Component& component : removable_components(mesh, locked, largest)) {
        if (mesh.face_count() <= target_faces) break;
        for (const Index f : component.faces) recorder.before_deletion(f);
        remove_component(mesh, pairs, component, killed);
        ++removed;
    }
    return removed;
}

FAQEM_ENGINE_END
