#include "soak/dirty_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/meshes.hpp"

namespace faqem::soak {

namespace {

using test::Random;

// Parts of these in a dirty model are what a scan, a scene or a generator leaves.
TriangleMesh shape(Random& random, double size, std::string& story) {
    const auto n = static_cast<Index>(size * random.between(5, 14));
    switch (random.below(9)) {
        case 0:
            story = "grid";
            return test::square(n, 2, 0);
        case 1:
            story = "ball";
            return test::icosphere(size > 2 ? 6 : 2 + static_cast<int>(random.below(2)));
        case 2:
            story = "globe";
            return test::globe(n, 1);
        case 3:
            story = "torus";
            return test::torus(2 * n, n);
        case 4:
            story = "tube";
            return test::cylinder(n, n, random.between(0.1, 20));
        case 5:
            story = "fan";
            return test::fan(20 * n);
        case 6:
            story = "soup";
            return test::soup(random.below(1000), std::size_t{10} * n, std::size_t{20} * n);
        case 7: {
            story = "boxes";
            TriangleMesh all;
            for (Index i = 0; i < 4 * n; ++i) {
                const Vec3 at = {double(random.below(5)), double(random.below(5)), double(random.below(5))};
                all = test::both(std::move(all),
                                 test::moved(test::scaled(test::cube(), random.between(0.2, 1)), at));
            }
            return all;
        }
        default:
            story = "hills";
            TriangleMesh mesh = test::square(n, 2, 0);
            for (Vec3& p : mesh.positions) p[2] = 0.3 * std::sin(5 * p[0]) * std::cos(4 * p[1]);
            return mesh;
    }
}

double diagonal(const TriangleMesh& mesh) {
    Vec3 low = mesh.positions.front(), high = low;
    for (const Vec3& p : mesh.positions)
        for (unsigned i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

// From 10^low to 10^high.
double power(Random& random, double low, double high) { return std::pow(10, random.between(low, high)); }

// What is on one side of a plane that goes through a vertex.
template <class Act>
void beyond_plane(TriangleMesh& mesh, Random& random, Act act) {
    const Vec3 n = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const auto along = [&](Index v) {
        const Vec3& p = mesh.positions[v];
        return n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
    };
    const double at = along(random.below(mesh.positions.size()));
    act([&](const Triangle& t) { return along(t[0]) > at; });
}

// Every damage leaves indices in range and positions finite.

void cut(TriangleMesh& mesh, Random& random) {
    const TriangleMesh before = mesh;
    if (random.below(2)) {
        beyond_plane(mesh, random, [&](const auto& is_beyond) { std::erase_if(mesh.triangles, is_beyond); });
    } else {
        const double share = random.between(0.01, 0.5);
        std::erase_if(mesh.triangles, [&](const Triangle&) { return random.unit() < share; });
    }
    if (mesh.triangles.empty()) mesh = before;
}

void flip(TriangleMesh& mesh, Random& random) {
    if (random.below(2)) {
        beyond_plane(mesh, random, [&](const auto& is_beyond) {
            for (Triangle& t : mesh.triangles)
                if (is_beyond(t)) std::swap(t[1], t[2]);
        });
    } else {
        const double share = random.between(0.01, 0.6);
        for (Triangle& t : mesh.triangles)
            if (random.unit() < share) std::swap(t[1], t[2]);
    }
}

void duplicate_faces(TriangleMesh& mesh, Random& random) {
    const double share = random.between(0.01, 0.5);
    const std::size_t faces = mesh.triangles.size();
    const bool is_other_side = random.below(2);
    for (std::size_t f = 0; f < faces; ++f) {
        const auto [a, b, c] = mesh.triangles[f];
        if (random.unit() < share)
            mesh.triangles.push_back(is_other_side ? Triangle{a, c, b} : Triangle{b, c, a});
    }
}

// The whole a second time, where it is or close to it.
void double_all(TriangleMesh& mesh, Random& random) {
    const double by = random.below(2) ? 0 : diagonal(mesh) * power(random, -9, -2);
    TriangleMesh other = test::moved(mesh, {by, 0, by});
    if (random.below(2)) other = test::inside_out(std::move(other));
    mesh = test::both(std::move(mesh), other);
}

// Faces get vertices of others.
void weld_wrongly(TriangleMesh& mesh, Random& random) {
    const std::size_t wrong = 1 + random.below(mesh.triangles.size() / 10 + 1);
    for (std::size_t i = 0; i < wrong; ++i)
        mesh.triangles[random.below(mesh.triangles.size())][random.below(3)] =
            random.below(mesh.positions.size());
}

// On a coarse lattice: neighbours fall together, sheets as well.
void weld_too_far(TriangleMesh& mesh, Random& random) {
    const double cell = diagonal(mesh) * power(random, -3, -1);
    if (!(cell > 0)) return;
    for (Vec3& p : mesh.positions)
        for (double& x : p) x = cell * std::round(x / cell);
}

// Every face on its own, its corners close to where its neighbours' are.
void unweld(TriangleMesh& mesh, Random& random) {
    const double by = random.below(2) ? 0 : diagonal(mesh) * power(random, -12, -4);
    std::vector<Vec3> positions;
    for (Triangle& t : mesh.triangles)
        for (Index& v : t) {
            Vec3 p = mesh.positions[v];
            for (double& x : p) x += random.between(-by, by);
            v = static_cast<Index>(positions.size());
            positions.push_back(p);
        }
    mesh.positions = std::move(positions);
}

void noise(TriangleMesh& mesh, Random& random) {
    const double by = diagonal(mesh) * power(random, -8, -1.5);
    mesh = test::shaken(std::move(mesh), by, random.below(1000));
}

// Single vertices far away, as bad depths leave them.
void spikes(TriangleMesh& mesh, Random& random) {
    const double by = diagonal(mesh) * power(random, -1, 4);
    for (std::size_t i = 1 + random.below(5); i > 0; --i)
        mesh.positions[random.below(mesh.positions.size())][random.below(3)] += random.between(-by, by);
}

// Flat, or nearly.
void flatten(TriangleMesh& mesh, Random& random) {
    const double by = random.below(3) ? power(random, -12, -2) : 0;
    const std::size_t axis = random.below(3);
    for (Vec3& p : mesh.positions) p[axis] *= by;
}

// Faces of no area, and faces with a vertex beside an edge that their neighbours do not have.
void needles(TriangleMesh& mesh, Random& random) {
    const std::size_t faces = mesh.triangles.size();
    for (std::size_t i = 0; i < 1 + faces / 20; ++i) {
        Triangle& t = mesh.triangles[random.below(faces)];
        const auto [a, b, c] = t;
        const auto middle = static_cast<Index>(mesh.positions.size());
        const double at = random.between(0, 1), eps = random.below(2) ? 0 : power(random, -15, -3);
        Vec3 p;
        for (unsigned k = 0; k < 3; ++k) {
            const double edge = (1 - at) * mesh.positions[a][k] + at * mesh.positions[b][k];
            p[k] = edge + eps * (mesh.positions[c][k] - edge);
        }
        mesh.positions.push_back(p);
        switch (random.below(3)) {
            case 0:  // the face is split, its neighbour is not
                t = {a, middle, c};
                mesh.triangles.push_back({middle, b, c});
                break;
            case 1:
                mesh.triangles.push_back({a, b, middle});
                break;
            default:
                mesh.triangles.push_back({a, b, a});
        }
    }
}

// Other units, far from the origin.
void place(TriangleMesh& mesh, Random& random) {
    mesh = test::scaled(std::move(mesh), power(random, -25, 25));
    if (random.below(2)) {
        const double far = diagonal(mesh) * power(random, 0, 6);
        mesh = test::moved(std::move(mesh), {far, -far, far / 3});
    }
}

void stray_vertices(TriangleMesh& mesh, Random& random) {
    const std::size_t before = mesh.positions.size();
    for (std::size_t i = 1 + random.below(50); i > 0; --i) {
        Vec3 p = mesh.positions[random.below(before)];
        for (double& x : p) x *= random.between(-3, 3);
        mesh.positions.push_back(p);
    }
}

struct Damage {
    const char* name;
    void (*do_it)(TriangleMesh&, Random&);
};
constexpr Damage kinds[] = {
    {"cut", cut},
    {"flipped", flip},
    {"faces doubled", duplicate_faces},
    {"all doubled", double_all},
    {"cut", cut},
    {"flipped", flip},
    {"welded wrongly", weld_wrongly},
    {"welded too far", weld_too_far},
    {"unwelded", unweld},
    {"noised", noise},
    {"noised", noise},
    {"spikes", spikes},
    {"flattened", flatten},
    {"needles", needles},
    {"placed", place},
    {"stray vertices", stray_vertices},
};

// Two floats per corner, with a seam now and then.
void add_attributes(TriangleMesh& mesh, Random& random) {
    mesh.attributes.width = 2;
    for (const Triangle& t : mesh.triangles) {
        const auto chart = static_cast<float>(random.below(20) == 0);
        for (const Index v : t)
            for (const std::size_t axis : {0, 1})
                mesh.attributes.values.push_back(static_cast<float>(std::fmod(mesh.positions[v][axis], 1e6)) +
                                                 chart);
    }
}

void make_wrong(DirtyMesh& dirty, Random& random) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    TriangleMesh& mesh = dirty.mesh;
    const Index f = random.below(mesh.triangles.size());
    const std::size_t corner = random.below(3);
    dirty.is_wrong = true;
    switch (random.below(3)) {
        case 0:
            dirty.story += ", an index out of range";
            mesh.triangles[f][corner] = static_cast<Index>(mesh.positions.size()) + random.below(1000);
            break;
        case 1:
            dirty.story += ", no index";
            mesh.triangles[f][corner] = no_index;
            break;
        default:
            dirty.story += ", a position that is not finite";
            mesh.positions[mesh.triangles[f][corner]][random.below(3)] =
                random.below(2) ? infinity : std::numeric_limits<double>::quiet_NaN();
    }
}

}  // namespace

DirtyMesh dirty_mesh(std::uint32_t number) {
    Random random(number);
    DirtyMesh dirty;
    const double size = number % 1000 == 999 ? 16 : 1;
    dirty.mesh = shape(random, size, dirty.story);
    for (Index i = 1 + random.below(4); i > 0; --i) {
        const Damage& damage = kinds[random.below(std::size(kinds))];
        dirty.story += std::string(", ") + damage.name;
        damage.do_it(dirty.mesh, random);
    }
    if (random.below(5) == 0) {
        for (std::size_t f = 0; f < dirty.mesh.triangles.size(); ++f)
            dirty.mesh.face_groups.push_back(f < dirty.mesh.triangles.size() / 2 ? 0 : random.below(3));
    }
    if (random.below(5) == 0) add_attributes(dirty.mesh, random);
    if (random.below(25) == 0) make_wrong(dirty, random);
    return dirty;
}

}  // namespace faqem::soak
