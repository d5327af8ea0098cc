#include "isosurface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "faqem/engine/mesh/vector.hpp"

namespace faqem::bench {

namespace {

using Cell = std::array<std::uint32_t, 3>;  ///< grid indices of a cell or of a grid point (its lowest corner)

constexpr int octaves = 7;
constexpr double first_frequency = 3, first_amplitude = 0.11, gain = 0.45;
constexpr double radius = 0.3;
constexpr double scanner_noise = 0.3;  ///< amplitude of the white noise, in cells

std::uint64_t mixed(std::uint64_t x) {  // finaliser of SplitMix64 (Steele et al. 2014)
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// White noise: a hash of integer coordinates, in [-1, 1).
double white(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
    std::uint64_t h = mixed(static_cast<std::uint64_t>(x) + seed * 0x9e3779b97f4a7c15ull);
    h = mixed(static_cast<std::uint64_t>(y) + h);
    h = mixed(static_cast<std::uint64_t>(z) + h);
    return static_cast<double>(h >> 11) * 0x1p-52 - 1;
}

double mix(double a, double b, double t) { return a + (b - a) * t; }

/// Value noise: white noise at integer coordinates, interpolated with a quintic polynomial.
double smooth(const Vec3& p, std::uint64_t seed) {
    std::array<std::int64_t, 3> whole;
    Vec3 t;
    for (std::size_t k = 0; k < 3; ++k) {
        const double floor = std::floor(p[k]), f = p[k] - floor;
        whole[k] = static_cast<std::int64_t>(floor);
        t[k] = f * f * f * (f * (f * 6 - 15) + 10);
    }
    std::array<double, 4> row;
    for (int i = 0; i < 4; ++i) {
        const std::int64_t y = whole[1] + i % 2, z = whole[2] + i / 2;
        row[static_cast<std::size_t>(i)] =
            mix(white(whole[0], y, z, seed), white(whole[0] + 1, y, z, seed), t[0]);
    }
    return mix(mix(row[0], row[1], t[1]), mix(row[2], row[3], t[1]), t[2]);
}

/// The scalar field on a grid over [-0.5, 0.5]^3. Negative values are inside.
class Field {
public:
    Field(std::uint32_t cells, std::uint64_t seed) : cells_(cells), seed_(seed) {}

    std::uint32_t cells() const { return cells_; }

    Vec3 position(const Cell& g) const {
        Vec3 p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = static_cast<double>(g[k]) / cells_ - 0.5;
        return p;
    }

    double at(const Cell& g) const {
        for (const std::uint32_t c : g) {
            if (c == 0 || c == cells_)
                return 1;  // outside at the boundary of the grid, so that the surface is closed
        }
        const Vec3 p = position(g);
        double value = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - radius;
        double frequency = first_frequency, amplitude = first_amplitude;
        for (int i = 0; i < octaves; ++i) {
            const Vec3 q = {p[0] * frequency, p[1] * frequency, p[2] * frequency};
            value += amplitude * smooth(q, seed_ + static_cast<std::uint64_t>(i));
            frequency *= 2;
            amplitude *= gain;
        }
        return value + scanner_noise / cells_ * white(g[0], g[1], g[2], ~seed_);
    }

private:
    std::uint32_t cells_;
    std::uint64_t seed_;
};

std::uint64_t key_of(const Cell& c) {
    return static_cast<std::uint64_t>(c[2]) << 42 | static_cast<std::uint64_t>(c[1]) << 21 | c[0];
}

Cell cell_of(std::uint64_t key) {
    constexpr std::uint64_t mask = (1u << 21) - 1;
    return {static_cast<std::uint32_t>(key & mask), static_cast<std::uint32_t>(key >> 21 & mask),
            static_cast<std::uint32_t>(key >> 42)};
}

/// Grid point of corner i of a cell. Bit k of i is its offset along axis k.
Cell corner(const Cell& c, unsigned i) { return {c[0] + (i & 1), c[1] + (i >> 1 & 1), c[2] + (i >> 2)}; }

/// Returns the cells that contain the surface, in scan-line order. They are found by flood fill from a seed.
std::vector<std::uint64_t> crossed_cells(const Field& field) {
    // The seed is the first crossing along an axis from the centre.
    const std::uint32_t middle = field.cells() / 2;
    Cell seed = {middle, middle, middle};
    const auto inside = [&](const Cell& g) { return field.at(g) < 0; };
    const bool start = inside(seed);
    while (seed[0] < field.cells() && inside({seed[0] + 1, middle, middle}) == start) ++seed[0];
    if (seed[0] >= field.cells()) throw std::runtime_error("the field has no isosurface");

    std::unordered_set<std::uint64_t> found = {key_of(seed)};
    std::vector<std::uint64_t> open = {key_of(seed)};
    while (!open.empty()) {
        const Cell cell = cell_of(open.back());
        open.pop_back();
        unsigned in = 0;
        for (unsigned i = 0; i < 8; ++i) in |= static_cast<unsigned>(inside(corner(cell, i))) << i;
        for (std::size_t k = 0; k < 3; ++k) {
            for (const bool up : {false, true}) {
                unsigned face = 0;
                for (unsigned i = 0; i < 8; ++i) face |= static_cast<unsigned>((i >> k & 1) == up) << i;
                if ((in & face) == 0 || (in & face) == face) continue;
                Cell next = cell;
                up ? ++next[k] : --next[k];
                if (found.insert(key_of(next)).second) open.push_back(key_of(next));
            }
        }
    }
    std::vector<std::uint64_t> cells(found.begin(), found.end());
    std::sort(cells.begin(), cells.end());
    return cells;
}

/// Marching tetrahedra. Cells must be visited layer by layer.
class March {
public:
    explicit March(const Field& field) : field_(field) {}

    void cell(const Cell& c) {
        std::array<double, 8> values;
        for (unsigned i = 0; i < 8; ++i) values[i] = field_.at(corner(c, i));
        // Kuhn subdivision: one tetrahedron for each permutation of the axes, with a path from corner 0 to
        // corner 7.
        static constexpr std::array<std::array<unsigned, 2>, 6> middles = {
            {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}};
        for (const auto& [a, b] : middles) tetrahedron(c, values, {0, a, b, 7});
    }

    /// Begins a new layer. Forgets the edges of the layer before the last one, which are not needed any more.
    void forget_layer() {
        last_.swap(now_);
        now_.clear();
    }

    TriangleMesh mesh;

private:
    void tetrahedron(const Cell& c, const std::array<double, 8>& values, const std::array<unsigned, 4>& t) {
        std::array<unsigned, 4> in{}, out{};
        std::size_t ins = 0, outs = 0;
        for (const unsigned i : t) (values[i] < 0 ? in[ins++] : out[outs++]) = i;
        if (ins == 0 || outs == 0) return;
        const auto v = [&](unsigned a, unsigned b) { return vertex(c, a, b, values); };
        if (ins == 1)
            triangle(v(in[0], out[0]), v(in[0], out[1]), v(in[0], out[2]), c, in[0]);
        else if (outs == 1)
            triangle(v(in[0], out[0]), v(in[1], out[0]), v(in[2], out[0]), c, in[0]);
        else {
            const Index a = v(in[0], out[0]), b = v(in[0], out[1]), d = v(in[1], out[0]),
                        e = v(in[1], out[1]);
            triangle(a, b, e, c, in[0]);
            triangle(a, e, d, c, in[0]);
        }
    }

    /// Adds a triangle, oriented so that the inside corner of the cell is on its back side.
    void triangle(Index a, Index b, Index d, const Cell& c, unsigned inside) {
        const auto at = [&](Index v) { return engine::to_eigen(mesh.positions[v]); };
        const engine::Vector3 from_inside = at(a) - engine::to_eigen(field_.position(corner(c, inside)));
        const double volume = from_inside.dot(engine::area_vector(at(a), at(b), at(d)));
        mesh.triangles.push_back(volume > 0 ? Triangle{a, b, d} : Triangle{a, d, b});
    }

    /// Returns the vertex on the edge between two corners of a cell. All cells at the edge share it.
    Index vertex(const Cell& c, unsigned i, unsigned j, const std::array<double, 8>& values) {
        if (i > j) std::swap(i, j);  // then the bits of i are a subset of the bits of j
        const Cell a = corner(c, i), b = corner(c, j);
        const std::uint64_t key = key_of(a) << 3 | (j ^ i);
        if (const auto old = last_.find(key); old != last_.end()) return old->second;
        const auto [entry, is_new] = now_.emplace(key, static_cast<Index>(mesh.positions.size()));
        if (is_new) {
            // Clamped, because vertices of several edges would coincide at the ends.
            const double t = std::clamp(values[i] / (values[i] - values[j]), 0.02, 0.98);
            const Vec3 p = field_.position(a), q = field_.position(b);
            mesh.positions.push_back({mix(p[0], q[0], t), mix(p[1], q[1], t), mix(p[2], q[2], t)});
        }
        return entry->second;
    }

    const Field& field_;
    std::unordered_map<std::uint64_t, Index> last_,
        now_;  ///< vertices by edge, of the previous and current layer
};

}  // namespace

TriangleMesh isosurface(std::uint32_t cells, std::uint64_t seed) {
    const Field field(std::max(cells, 8u), seed);
    March march(field);
    std::uint32_t layer = 0;
    for (const std::uint64_t key : crossed_cells(field)) {
        const Cell cell = cell_of(key);
        if (cell[2] != layer) march.forget_layer();
        layer = cell[2];
        march.cell(cell);
    }
    return std::move(march.mesh);
}

TriangleMesh isosurface_of(std::size_t faces, std::uint64_t seed) {
    double cells = 64;
    // Because of the noise, the number of faces grows slightly faster than the square of the resolution: the
    // estimate from a low resolution is refined at a quarter of the estimated resolution.
    for (const double part : {1.0, 0.25}) {
        const auto n = static_cast<std::uint32_t>(std::max(8.0, part * cells));
        const double found = static_cast<double>(isosurface(n, seed).triangles.size());
        cells = n * std::sqrt(static_cast<double>(faces) / found);
    }
    return isosurface(static_cast<std::uint32_t>(cells), seed);
}

}  // namespace faqem::bench
