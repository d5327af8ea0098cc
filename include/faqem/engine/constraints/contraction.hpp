#pragma once
/// \file
/// Contraction of several vertices at once, where the collapse of one pair would not leave a closed surface.

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/engine/quadric/quadric.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_ENGINE_BEGIN

/// Price of the last faces of a connected component: 33 times the square of their area. The component causes an error of
/// at least its own size, and may be the only surface in a large neighbourhood. This is about a hundred times the fourth power of
/// the edge of a regular tetrahedron, and little for a rope or a twig, which covers little of any picture.
/// \param for_each_face  calls a function with each of the faces
template <class ForEachFace>
double last_faces_price(const CollapseMesh& mesh, ForEachFace&& for_each_face) {
    double area = 0;
    for_each_face([&](Index f) { area += mesh.area(f); });
    return 33 * area * area;
}

/// A face that remains after a contraction; its corners are the new vertex, a and b.
struct RemainingFace {
    Index face, a, b;
};

/// The smallest set of vertices that contains a pair and can be contracted to one vertex so that a closed surface
/// stays closed: no edge of the new vertex has more than two faces, and no two faces have the same corners. Where a
/// handle is cut by three edges, for example, these are the three vertices. Not thread-safe.
class Contraction {
public:
    /// Larger sets are not contracted.
    static constexpr std::size_t max_vertices = 32;

    /// \param vertices  number of vertex slots
    explicit Contraction(std::size_t vertices) : is_inside_(vertices, 0) {}

    /// \param closed   see LoopOptions::closed
    void keep_closed(std::span<const std::uint8_t> closed) { closed_.assign(closed.begin(), closed.end()); }
    /// To be called for each collapse.
    void after_collapse(Index survivor, Index removed) {
        if (!closed_.empty()) closed_[survivor] |= closed_[removed];
    }

    /// Finds the set for the pair (u, v), if it belongs to a surface that stays closed. Two faces with the same
    /// corners, a flap without volume, are removed with a vertex that has no other faces.
    /// \return whether the set has more vertices: the pair must not be collapsed alone
    bool find(const CollapseMesh& mesh, Index u, Index v) {
        if (!is_closed(u, v)) return false;
        for (const Index w : vertices_) is_inside_[w] = 0;
        vertices_.clear();
        add(u), add(v);
        do {
            if (vertices_.size() > max_vertices) return true;
            find_faces(mesh);
        } while (grow(mesh));
        return vertices_.size() > 2;
    }

    /// Why the set cannot be contracted, or nothing. Positions are not tested.
    /// \param degenerate  upper bound of the number of degenerate faces of the mesh, which alone must not remain
    /// \param locked      one per vertex slot; vertices with a nonzero entry must not vanish
    std::optional<Refusal> refusal(const CollapseMesh& mesh, std::size_t degenerate,
                                   std::span<const std::uint8_t> locked) const {
        if (vertices_.size() > max_vertices) return Refusal::link;
        if (vanishing_.size() + degenerate >= mesh.face_count()) return Refusal::last_faces;
        const auto is_locked = [&](Index v) { return locked[v] != 0; };
        if (remaining_.empty() && std::any_of(vertices_.begin(), vertices_.end(), is_locked))
            return Refusal::locked;
        for (const Index w : corners_)
            if (is_locked(w) && loses_all_faces(mesh, w)) return Refusal::locked;
        return std::nullopt;
    }

    /// The set, beginning with u and v.
    const std::vector<Index>& vertices() const { return vertices_; }
    bool contains(Index v) const { return is_inside_[v] != 0; }
    /// The faces with one corner in the set. The others with a corner in it vanish.
    const std::vector<RemainingFace>& remaining() const { return remaining_; }
    /// The faces that vanish.
    const std::vector<Index>& vanishing() const { return vanishing_; }

    /// Contracts the set by the collapses of pairs.
    /// \param fixed     as for candidate()
    /// \param collapse  called with survivor, removed vertex and pair; must collapse them
    /// \throws Cancelled  if `collapse` does, but not before the whole set is contracted
    template <class Collapse>
    void apply(const CollapseMesh& mesh, const PairTable& pairs, Index fixed, Collapse&& collapse) const {
        const auto has_fewer = [&](Index v, Index w) { return mesh.degree(v) < mesh.degree(w); };
        const Index survivor =
            fixed != no_index ? fixed : *std::max_element(vertices_.begin(), vertices_.end(), has_fewer);
        std::optional<Cancelled> stopped;
        while (true) {
            Neighbour inner;
            pairs.for_each_pair(survivor, [&](Neighbour n) {
                if (inner.pair == no_index && contains(n.vertex)) inner = n;
            });
            if (inner.pair == no_index) break;
            try {
                collapse(survivor, inner.vertex, inner.pair);
            } catch (const Cancelled& by) {
                stopped = by;
            }
        }
        if (stopped) throw *stopped;
    }

    /// Finds the vertex of the set that must not move.
    /// \param allowed_position  called with two vertices of a pair
    /// \param fixed             becomes that vertex; unchanged if the new vertex may be anywhere
    /// \return false if the set must not be contracted
    template <class AllowedPositionOf>
    bool find_fixed_vertex(const PairTable& pairs, AllowedPositionOf&& allowed_position, Index& fixed) const {
        bool is_legal = true;
        for (const Index v : vertices_) {
            pairs.for_each_pair(v, [&](Neighbour n) {
                if (n.vertex < v || !contains(n.vertex)) return;
                const AllowedPosition at = allowed_position(v, n.vertex);
                if (at == AllowedPosition::anywhere) return;
                const Index stays = at == AllowedPosition::at_first ? v : n.vertex;
                is_legal =
                    is_legal && at != AllowedPosition::nowhere && (fixed == no_index || fixed == stays);
                fixed = stays;
            });
        }
        return is_legal;
    }

    /// Position and price. The price is the sum of squared distances from the planes of all faces, weighted by area,
    /// but at least the fourth power of the diameter (see RuleExceptions::lift()), plus that of last faces.
    /// \param fixed  a vertex of the set that does not move; no_index: the position of the lowest sum
    Candidate candidate(const CollapseMesh& mesh, Index fixed) const {
        const Vector3& origin = mesh.position(vertices_[0]);
        Quadric q;
        const auto add_plane = [&](Index f) {
            const Vector3 point = mesh.position(mesh.triangle(f)[0]) - origin;
            q += Quadric::plane_through(mesh.normal(f), point, mesh.area(f));
        };
        for (const Index f : vanishing_) add_plane(f);
        for (const RemainingFace& face : remaining_) add_plane(face.face);
        Eigen::AlignedBox3d box;
        double square = 0;
        for (const Index v : vertices_) {
            box.extend(mesh.position(v) - origin);
            for (const Index w : vertices_)
                square = std::max(square, (mesh.position(v) - mesh.position(w)).squaredNorm());
        }
        const Eigen::AlignedBox3d bounds = placement_bounds(box);
        const Index other = fixed != no_index ? fixed : vertices_[1];
        const Vector3 p = optimal_position(
            q, Vector3::Zero(), mesh.position(other) - origin,
            fixed != no_index ? AllowedPosition::at_second : AllowedPosition::anywhere, &bounds);
        double cost = std::max(q(p), square * square);
        if (remaining_.empty()) {
            cost += last_faces_price(mesh, [&](auto&& visit) {
                for (const Index f : vanishing_) visit(f);
            });
        }
        return {fixed != no_index ? mesh.position(fixed) : Vector3(p + origin), cost};
    }

private:
    bool is_closed(Index u, Index v) const { return !closed_.empty() && (closed_[u] || closed_[v]); }

    void add(Index v) {
        if (!std::exchange(is_inside_[v], std::uint8_t{1})) vertices_.push_back(v);
    }

    void find_faces(const CollapseMesh& mesh) {
        remaining_.clear();
        vanishing_.clear();
        corners_.clear();
        for (const Index m : vertices_) {
            mesh.for_each_face(m, [&](Index f, unsigned corner) {
                const Triangle& t = mesh.triangle(f);
                if ((corner > 0 && contains(t[0])) || (corner > 1 && contains(t[1])))
                    return;  // visited there
                const Index a = t[(corner + 1) % 3], b = t[(corner + 2) % 3];
                if (contains(a) || contains(b))
                    vanishing_.push_back(f);
                else
                    remaining_.push_back({f, a, b});
                for (const Index w : {a, b})
                    if (!contains(w)) corners_.push_back(w);
            });
        }
        std::sort(corners_.begin(), corners_.end());
        separate_flaps();
        ends_.clear();
        for (const RemainingFace& face : remaining_) ends_.insert(ends_.end(), {face.a, face.b});
        std::sort(ends_.begin(), ends_.end());
    }

    // Moves pairs of faces with the same corners from remaining_ to flaps_.
    void separate_flaps() {
        const auto key = [](const RemainingFace& r) { return std::pair(std::minmax(r.a, r.b), r.face); };
        std::sort(remaining_.begin(), remaining_.end(),
                  [&](const RemainingFace& r, const RemainingFace& s) { return key(r) < key(s); });
        flaps_.clear();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < remaining_.size(); ++i) {
            const bool is_flap = i + 1 < remaining_.size() && remaining_[i].a == remaining_[i + 1].b &&
                                 remaining_[i].b == remaining_[i + 1].a;
            if (is_flap)
                flaps_.push_back(remaining_[i++]);
            else
                remaining_[kept++] = remaining_[i];
        }
        remaining_.resize(kept);
    }

    static std::size_t count(const std::vector<Index>& sorted, Index v) {
        const auto [begin, end] = std::equal_range(sorted.begin(), sorted.end(), v);
        return static_cast<std::size_t>(end - begin);
    }

    // \param w  outside of the set
    bool loses_all_faces(const CollapseMesh& mesh, Index w) const {
        return count(ends_, w) == 0 && count(corners_, w) == mesh.degree(w);
    }

    // Returns false if the set is complete.
    bool grow(const CollapseMesh& mesh) {
        const std::size_t before = vertices_.size();
        for (std::size_t i = 2; i < ends_.size(); ++i)
            if (ends_[i] == ends_[i - 2]) add(ends_[i]);
        if (vertices_.size() > before) return true;
        for (const RemainingFace& flap : flaps_) {
            for (const Index w : {flap.a, flap.b})
                if (loses_all_faces(mesh, w)) add(w);
        }
        if (vertices_.size() > before) return true;
        if (flaps_.empty()) return false;
        const RemainingFace& flap = flaps_.front();
        const Vector3& p = mesh.position(vertices_.front());
        const bool a_is_nearer =
            (mesh.position(flap.a) - p).squaredNorm() < (mesh.position(flap.b) - p).squaredNorm();
        add(a_is_nearer ? flap.a : flap.b);
        return true;
    }

    std::vector<Index> vertices_, vanishing_;
    std::vector<std::uint8_t> is_inside_;  // per vertex slot
    std::vector<std::uint8_t> closed_;     // empty, or per vertex slot
    std::vector<RemainingFace> remaining_, flaps_;
    std::vector<Index> corners_, ends_;  // outside corners of all faces, and of remaining_, sorted
};

FAQEM_ENGINE_END
