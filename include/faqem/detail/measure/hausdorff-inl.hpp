#pragma once

#include "faqem/detail/measure/hausdorff.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "faqem/detail/measure/covering.hpp"

FAQEM_DETAIL_BEGIN

inline constexpr std::size_t vertex_block = 4096, face_block = 4096, piece_block = 128, cover_block = 32;
/// Number of pieces that are split in parallel: several blocks, so that several threads have work.
inline constexpr std::size_t batch_size = 16 * piece_block;
inline constexpr std::size_t stop_interval = 16 * vertex_block;

/// A triangular part of a face, with faces of the other surface that are probably close to it.
struct Piece {
    std::array<Vector3, 3> corner;
    std::array<Index, 3> nearest;                                ///< face closest to each corner
    Index of = no_index;                                         ///< the whole face
    std::array<Index, 2> bounding_faces = {no_index, no_index};  ///< the faces that determine the bound
    double bound_squared = std::numeric_limits<double>::infinity();
};

/// A set of up to 8 faces.
struct Candidates {
    std::array<Index, 8> face;
    std::size_t size = 0;

    void add(Index f) {
        if (f == no_index || std::find(face.begin(), face.begin() + size, f) != face.begin() + size) return;
        face[size++] = f;
    }
    explicit Candidates(const Piece& piece) {
        for (const Index f : piece.nearest) add(f);
        for (const Index f : piece.bounding_faces) add(f);
    }
};

/// Squared distances of a point to candidates.
using Distances = std::array<double, 8>;

inline Distances distances(const Surface& to, const Vector3& p, const Candidates& candidates) {
    Distances result;
    for (std::size_t i = 0; i < candidates.size; ++i) result[i] = to.distance_squared(p, candidates.face[i]);
    return result;
}

/// Squared upper bound of the distance of a piece to the faces f and g. The piece is divided into a polygon
/// closer to f and one closer to g; since the distance to a face is convex, each polygon is bounded by the
/// distances of its corners to its face. Any division gives a valid bound; this one would be optimal if f and
/// g were planes through a common edge.
/// \param to_f,to_g  squared distances of the corners to f and g
/// \return infinity if the bound would not be below that of the piece
inline double bound_by_two_faces(const Surface& to, const Piece& piece, Index f, Index g,
                                 const std::array<double, 3>& to_f, const std::array<double, 3>& to_g) {
    double bound = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        bound = std::max(bound, std::min(to_f[k], to_g[k]));
        const std::size_t n = (k + 1) % 3;
        if ((to_f[k] <= to_g[k]) == (to_f[n] <= to_g[n])) continue;
        const double here = std::sqrt(std::abs(to_g[k] - to_f[k]));
        const double there = std::sqrt(std::abs(to_g[n] - to_f[n]));
        const Vector3 cut = piece.corner[k] + here / (here + there) * (piece.corner[n] - piece.corner[k]);
        const double at_cut = std::max(to.distance_squared(cut, f), to.distance_squared(cut, g));
        if (!(at_cut < piece.bound_squared))
            return std::numeric_limits<double>::infinity();  // no improvement, or NaN
        bound = std::max(bound, at_cut);
    }
    return bound;
}

/// Lowers the bound of a piece as far as single candidates and pairs of candidates allow.
/// \param at      squared distances of the three corners to the candidates
/// \param enough  squared bound below which no further improvement is attempted
inline void tighten(const Surface& to, Piece& piece, const Candidates& candidates,
                    const std::array<const Distances*, 3>& at, double enough) {
    for (std::size_t i = 0; i < candidates.size; ++i) {
        const double bound = std::max({(*at[0])[i], (*at[1])[i], (*at[2])[i]});
        if (!(bound < piece.bound_squared)) continue;
        piece.bound_squared = bound;
        piece.bounding_faces = {candidates.face[i], no_index};
    }
    const auto column = [&](std::size_t i) { return std::array{(*at[0])[i], (*at[1])[i], (*at[2])[i]}; };
    for (std::size_t i = 0; i < candidates.size; ++i) {
        for (std::size_t j = i + 1; j < candidates.size; ++j) {
            if (piece.bound_squared <= enough) return;
            const std::array to_f = column(i), to_g = column(j);
            double least = 0;
            for (std::size_t k = 0; k < 3; ++k) least = std::max(least, std::min(to_f[k], to_g[k]));
            if (!(least < piece.bound_squared)) continue;
            const Index f = candidates.face[i], g = candidates.face[j];
            const double bound = bound_by_two_faces(to, piece, f, g, to_f, to_g);
            if (!(bound < piece.bound_squared)) continue;
            piece.bound_squared = bound;
            piece.bounding_faces = {f, g};
        }
    }
}

/// Squared upper bound at which a piece needs no further refinement.
/// \param value_squared  largest squared distance found so far
inline double enough_squared(double value_squared, const SearchLimits& limits) {
    if (limits.beyond) return limits.stop_below * limits.stop_below;
    const double enough = std::max(
        std::sqrt(value_squared) * (1 + limits.tolerance) + limits.absolute_tolerance, limits.stop_below);
    return enough * enough;
}

/// Result of one block of work.
struct Found {
    double value_squared = 0;   ///< largest squared distance found
    double closed_squared = 0;  ///< largest bound of the pieces that need no further refinement
    std::vector<Piece> open;    ///< pieces that need further refinement
    std::uint64_t pieces = 0;   ///< number of pieces that faces were split into
    bool collects = false;      ///< whether `beyond` is filled, see SearchLimits
    std::vector<std::array<Index, 2>> beyond;

    /// Adds the distance of a point of a piece. \return whether nothing else is to be known of the piece
    bool add(const Piece& piece, Index nearest, double distance_squared, double enough) {
        value_squared = std::max(value_squared, distance_squared);
        if (!collects || distance_squared <= enough) return false;
        beyond.push_back({piece.of, nearest});
        return true;
    }
    void keep(const Piece& piece, double enough) {
        if (piece.bound_squared <= enough)
            closed_squared = std::max(closed_squared, piece.bound_squared);
        else
            open.push_back(piece);
    }
    /// Adds what was found of other pieces, except the open ones.
    void merge(const Found& other) {
        value_squared = std::max(value_squared, other.value_squared);
        closed_squared = std::max(closed_squared, other.closed_squared);
        pieces += other.pieces;
        beyond.insert(beyond.end(), other.beyond.begin(), other.beyond.end());
    }
};

/// Computes upper bounds for whole faces.
/// \param at_vertices  see one_sided_hausdorff()
/// \param enough       squared bound at which a face needs no refinement
/// \param refine       if true, the centre is queried as well, and faces whose bound exceeds `enough` are
///                     kept as open pieces; if false, only the corners are used, and no face is kept
/// \param begin,end    range of faces
inline void bound_faces(const Surface& from, const Surface& to, const Bvh& tree,
                        const std::vector<NearestFace>& at_vertices, double enough, bool refine,
                        std::size_t begin, std::size_t end, Found& found) {
    CoherentQuery query(to, tree);
    for (std::size_t f = begin; f < end; ++f) {
        Piece piece;
        piece.of = static_cast<Index>(f);
        bool is_beyond = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = from.triangles[f][k];
            is_beyond =
                is_beyond || found.add(piece, at_vertices[v].face, at_vertices[v].distance_squared, enough);
            piece.corner[k] = to_eigen(from.positions[v]);
            piece.nearest[k] = at_vertices[v].face;
        }
        if (is_beyond) continue;
        piece.bounding_faces[0] = piece.nearest[0];
        const auto bound = [&](const Candidates& candidates) {
            std::array<Distances, 3> at;
            for (std::size_t k = 0; k < 3; ++k) at[k] = distances(to, piece.corner[k], candidates);
            tighten(to, piece, candidates, {&at[0], &at[1], &at[2]}, enough);
        };
        bound(Candidates(piece));
        if (refine && !(piece.bound_squared <= enough)) {
            // Where the surfaces coincide, each corner's closest face is an arbitrary one of its one-ring;
            // that of the centre is unique.
            const Vector3 centre = (piece.corner[0] + piece.corner[1] + piece.corner[2]) / 3;
            const Bvh::Hit hit = query(to_array(centre), piece.bounding_faces[0]);
            if (found.add(piece, hit.face, hit.distance_squared, enough)) continue;
            Candidates candidates(piece);
            candidates.add(hit.face);
            bound(candidates);
        }
        found.keep(piece, refine ? enough : std::numeric_limits<double>::infinity());
    }
}

/// Splits a piece at the midpoint of its longest edge, and bounds both halves.
inline void split(const Surface& to, CoherentQuery& query, const Piece& piece, double enough, Found& found) {
    found.pieces += 2;
    std::size_t longest = 0;
    double length = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double squared = (piece.corner[(k + 1) % 3] - piece.corner[k]).squaredNorm();
        if (!(squared > length)) continue;
        length = squared;
        longest = k;
    }
    const std::size_t next = (longest + 1) % 3;
    const Vector3 middle = 0.5 * piece.corner[longest] + 0.5 * piece.corner[next];
    const Bvh::Hit hit = query(to_array(middle), piece.bounding_faces[0]);
    if (found.add(piece, hit.face, hit.distance_squared, enough)) return;

    Candidates candidates(piece);
    candidates.add(hit.face);
    std::array<Distances, 3> at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = distances(to, piece.corner[k], candidates);
    const Distances at_middle = distances(to, middle, candidates);
    for (const std::size_t replaced : {longest, next}) {
        Piece child = piece;
        child.corner[replaced] = middle;
        child.nearest[replaced] = hit.face;
        std::array<const Distances*, 3> child_at = {&at[0], &at[1], &at[2]};
        child_at[replaced] = &at_middle;
        tighten(to, child, candidates, child_at, enough);
        found.keep(child, enough);
    }
}

/// How often a face is split if no set of faces covers it.
inline constexpr int cover_splits = 4;

/// Covers a piece, or after splits as many parts of it as possible.
/// \param splits  how often the piece is split at most
inline void cover(const Surface& to, CoherentQuery& query, const Covering& covering,
                  Covering::Scratch& scratch, Piece piece, int splits, double enough, Found& found) {
    const Vector3 middle = (piece.corner[0] + piece.corner[1] + piece.corner[2]) / 3;
    const Bvh::Hit hit = query(to_array(middle), piece.bounding_faces[0]);
    if (found.add(piece, hit.face, hit.distance_squared, enough)) return;
    if (hit.distance_squared <= enough) {
        const double bound = covering.bound(piece.corner, hit.face, std::sqrt(enough), scratch);
        piece.bound_squared = std::min(piece.bound_squared, bound * bound);
    }
    if (piece.bound_squared <= enough || splits == 0) return found.keep(piece, enough);
    Found halves;
    halves.collects = found.collects;
    split(to, query, piece, enough, halves);
    found.merge(halves);
    for (const Piece& half : halves.open)
        cover(to, query, covering, scratch, half, splits - 1, enough, found);
}

FAQEM_INLINE std::vector<NearestFace> nearest_faces_of_vertices(const Surface& from, const Surface& to,
                                                                const Bvh& tree, const RunContext& context,
                                                                double stop_above) {
    const std::size_t size = from.positions.size();
    std::vector<NearestFace> result;
    result.reserve(size);
    const std::size_t interval = stop_above < std::numeric_limits<double>::infinity() ? stop_interval : size;
    while (result.size() < size) {
        const std::size_t first = result.size();
        result.resize(std::min(size, first + interval));
        parallel_blocks(result.size() - first, vertex_block, context,
                        [&](std::size_t begin, std::size_t end) {
                            CoherentQuery query(to, tree);
                            for (std::size_t i = first + begin; i < first + end; ++i) {
                                const Bvh::Hit hit = query(from.positions[i]);
                                result[i] = {hit.face, hit.distance_squared};
                            }
                        });
        for (std::size_t i = first; i < result.size(); ++i)
            if (std::sqrt(result[i].distance_squared) > stop_above) return result;
    }
    return result;
}

FAQEM_INLINE HausdorffBounds one_sided_hausdorff(const Surface& from, const Surface& to, const Bvh& tree,
                                                 const std::vector<NearestFace>& at_vertices, double known,
                                                 const SearchLimits& limits, const RunContext& context) {
    Found empty, total;
    empty.collects = limits.beyond != nullptr;
    total.value_squared = known * known;
    for (const NearestFace& n : at_vertices)
        total.value_squared = std::max(total.value_squared, n.distance_squared);

    // By bound, the largest first; equal ones in the order of their insertion.
    std::multimap<double, Piece, std::greater<>> open;
    const auto enough = [&] { return enough_squared(total.value_squared, limits); };
    // Calls work(begin, end, found) for blocks of elements, and adds what each block has found.
    const auto in_blocks = [&](std::size_t size, std::size_t block, const auto& work) {
        std::vector<Found> blocks((size + block - 1) / block, empty);
        parallel_blocks(size, block, context,
                        [&](std::size_t begin, std::size_t end) { work(begin, end, blocks[begin / block]); });
        for (const Found& found : blocks) {
            total.merge(found);
            for (const Piece& piece : found.open) open.emplace(piece.bound_squared, piece);
        }
    };
    const auto pop = [&] { return open.extract(open.begin()).mapped(); };

    const bool refine = std::isfinite(limits.tolerance);
    double enough_now = refine ? enough() : 0;
    in_blocks(from.triangles.size(), face_block, [&](std::size_t begin, std::size_t end, Found& found) {
        bound_faces(from, to, tree, at_vertices, enough_now, refine, begin, end, found);
    });

    const auto may_go_on = [&] {
        return total.pieces < limits.max_pieces && !(std::sqrt(total.value_squared) > limits.stop_above);
    };
    std::vector<Piece> batch;
    if (!open.empty() && refine && may_go_on()) {
        const Covering covering(to);
        while (!open.empty()) batch.push_back(pop());
        enough_now = enough();
        in_blocks(batch.size(), cover_block, [&](std::size_t begin, std::size_t end, Found& found) {
            CoherentQuery query(to, tree);
            Covering::Scratch scratch(covering);
            for (std::size_t i = begin; i < end; ++i)
                cover(to, query, covering, scratch, batch[i], cover_splits, enough_now, found);
        });
    }
    const auto needs_work = [&] { return !open.empty() && open.begin()->first > enough(); };
    while (needs_work() && may_go_on()) {
        batch.clear();
        while (needs_work() && batch.size() < batch_size) batch.push_back(pop());
        enough_now = enough();
        in_blocks(batch.size(), piece_block, [&](std::size_t begin, std::size_t end, Found& found) {
            CoherentQuery query(to, tree);
            for (std::size_t i = begin; i < end; ++i) split(to, query, batch[i], enough_now, found);
        });
    }
    if (!open.empty()) total.closed_squared = std::max(total.closed_squared, open.begin()->first);
    if (limits.beyond) {
        while (needs_work()) {
            const Piece piece = pop();
            total.beyond.push_back({piece.of, piece.nearest[0]});
        }
        limits.beyond->insert(limits.beyond->end(), total.beyond.begin(), total.beyond.end());
    }
    return {std::sqrt(total.value_squared), std::sqrt(std::max(total.value_squared, total.closed_squared)),
            total.pieces};
}

FAQEM_INLINE HausdorffBounds two_sided_hausdorff(const Surface& a, const Bvh& tree_a, const Surface& b,
                                                 const Bvh& tree_b, const SearchLimits& limits,
                                                 const RunContext& context) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const auto largest = [](const std::vector<NearestFace>& nearest, double value) {
        for (const NearestFace& n : nearest) value = std::max(value, std::sqrt(n.distance_squared));
        return value;
    };
    const auto there = nearest_faces_of_vertices(a, b, tree_b, context, limits.stop_above);
    double value = largest(there, 0);
    if (value > limits.stop_above) return {value, unknown, 0};
    const auto back = nearest_faces_of_vertices(b, a, tree_a, context, limits.stop_above);
    value = largest(back, value);
    if (value > limits.stop_above) return {value, unknown, 0};

    // The value of the first direction is a lower bound for the second.
    const HausdorffBounds first = one_sided_hausdorff(a, b, tree_b, there, value, limits, context);
    if (first.value > limits.stop_above) return {first.value, unknown, first.pieces};
    const HausdorffBounds second = one_sided_hausdorff(b, a, tree_a, back, first.value, limits, context);
    return {second.value, std::max(first.bound, second.bound), first.pieces + second.pieces};
}

FAQEM_DETAIL_END
