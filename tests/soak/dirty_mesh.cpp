#include "soak/dirty_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/meshes.hpp"

namespace faqem::soak {

namespace {

using test::Random;

// A random shape; its name is stored in `description`.
TriangleMesh shape(Random& random, double size, std::string& description) {
    const auto n = static_cast<Index>(size * random.between(5, 14));
    switch (random.below(9)) {
        case 0:
            description = "grid";
            return test::square(n, 2, 0);
        case 1:
            description = "ball";
            return test::icosphere(size > 2 ? 6 : 2 + static_cast<int>(random.below(2)));
        case 2:
            description = "globe";
            return test::globe(n, 1);
        case 3:
            description = "torus";
            return test::torus(2 * n, n);
        case 4:
            description = "tube";
            return test::cylinder(n, n, random.between(0.1, 20));
        case 5:
            description = "fan";
            return test::fan(20 * n);
        case 6:
            description = "soup";
            return test::soup(random.below(1000), std::size_t{10} * n, std::size_t{20} * n);
        case 7: {
            description = "boxes";
            TriangleMesh all;
            for (Index i = 0; i < 4 * n; ++i) {
                const Vec3 at = {double(random.below(5)), double(random.below(5)), double(random.below(5))};
                all = test::both(std::move(all),
                                 test::moved(test::scaled(test::cube(), random.between(0.2, 1)), at));
            }
            return all;
        }
        default:
            description = "hills";
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

// A random number between 10^low and 10^high.
double power(Random& random, double low, double high) { return std::pow(10, random.between(low, high)); }

// Calls act(is_beyond), where is_beyond(triangle) is true on one side of a random plane through a random
// vertex.
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

// The following defects leave indices in range and positions finite.

// Deletes faces: on one side of a plane, or at random.
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

// Reverses faces: on one side of a plane, or at random.
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

// Duplicates faces at random, with the same or the opposite winding.
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

// Duplicates the whole mesh at the same position or close to it.
void double_all(TriangleMesh& mesh, Random& random) {
    const double by = random.below(2) ? 0 : diagonal(mesh) * power(random, -9, -2);
    TriangleMesh other = test::moved(mesh, {by, 0, by});
    if (random.below(2)) other = test::inside_out(std::move(other));
    mesh = test::both(std::move(mesh), other);
}

// Replaces corners of faces by random vertices.
void weld_wrongly(TriangleMesh& mesh, Random& random) {
    const std::size_t wrong = 1 + random.below(mesh.triangles.size() / 10 + 1);
    for (std::size_t i = 0; i < wrong; ++i)
        mesh.triangles[random.below(mesh.triangles.size())][random.below(3)] =
            random.below(mesh.positions.size());
}

// Rounds positions to a coarse lattice, so that neighbouring vertices, also of different surfaces, coincide.
void weld_too_far(TriangleMesh& mesh, Random& random) {
    const double cell = diagonal(mesh) * power(random, -3, -1);
    if (!(cell > 0)) return;
    for (Vec3& p : mesh.positions)
        for (double& x : p) x = cell * std::round(x / cell);
}

// Gives every face its own vertices, at or close to their former positions.
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

// Moves all vertices at random.
void noise(TriangleMesh& mesh, Random& random) {
    const double by = diagonal(mesh) * power(random, -8, -1.5);
    mesh = test::shaken(std::move(mesh), by, random.below(1000));
}

// Moves a few vertices far away, like outliers of a depth sensor.
void spikes(TriangleMesh& mesh, Random& random) {
    const double by = diagonal(mesh) * power(random, -1, 4);
    for (std::size_t i = 1 + random.below(5); i > 0; --i)
        mesh.positions[random.below(mesh.positions.size())][random.below(3)] += random.between(-by, by);
}

// Scales one axis by a very small factor or 0.
void flatten(TriangleMesh& mesh, Random& random) {
    const double by = random.below(3) ? power(random, -12, -2) : 0;
    const std::size_t axis = random.below(3);
    for (Vec3& p : mesh.positions) p[axis] *= by;
}

// Adds degenerate and needle-shaped faces, and T-junctions.
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
            case 0:  // splits the face, but not its neighbour
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

// Scales the mesh, and may move it far from the origin.
void place(TriangleMesh& mesh, Random& random) {
    mesh = test::scaled(std::move(mesh), power(random, -25, 25));
    if (random.below(2)) {
        const double far = diagonal(mesh) * power(random, 0, 6);
        mesh = test::moved(std::move(mesh), {far, -far, far / 3});
    }
}

// Adds unreferenced vertices.
void stray_vertices(TriangleMesh& mesh, Random& random) {
    const std::size_t before = mesh.positions.size();
    for (std::size_t i = 1 + random.below(50); i > 0; --i) {
        Vec3 p = mesh.positions[random.below(before)];
        for (double& x : p) x *= random.between(-3, 3);
        mesh.positions.push_back(p);
    }
}

struct Defect {
    const char* name;
    void (*apply)(TriangleMesh&, Random&);
};
constexpr Defect defects[] = {
    {"faces deleted", cut},
    {"faces reversed", flip},
    {"faces duplicated", duplicate_faces},
    {"mesh duplicated", double_all},
    {"faces deleted", cut},
    {"faces reversed", flip},
    {"welded wrongly", weld_wrongly},
    {"rounded to a lattice", weld_too_far},
    {"unwelded", unweld},
    {"noise", noise},
    {"noise", noise},
    {"outliers", spikes},
    {"flattened", flatten},
    {"needles", needles},
    {"scaled or moved", place},
    {"unreferenced vertices", stray_vertices},
};

// Adds two floats per corner, with occasional seams.
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

void make_invalid(DirtyMesh& dirty, Random& random) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    TriangleMesh& mesh = dirty.mesh;
    const Index f = random.below(mesh.triangles.size());
    const std::size_t corner = random.below(3);
    dirty.is_invalid = true;
    switch (random.below(3)) {
        case 0:
            dirty.description += ", an index out of range";
            mesh.triangles[f][corner] = static_cast<Index>(mesh.positions.size()) + random.below(1000);
            break;
        case 1:
            dirty.description += ", a corner without index";
            mesh.triangles[f][corner] = no_index;
            break;
        default:
            dirty.description += ", a position that is not finite";
            mesh.positions[mesh.triangles[f][corner]][random.below(3)] =
                random.below(2) ? infinity : std::numeric_limits<double>::quiet_NaN();
    }
}

}  // namespace

DirtyMesh dirty_mesh(std::uint32_t number) {
    Random random(number);
    DirtyMesh dirty;
    const double size = number % 1000 == 999 ? 16 : 1;
    dirty.mesh = shape(random, size, dirty.description);
    for (Index i = 1 + random.below(4); i > 0; --i) {
        const Defect& defect = defects[random.below(std::size(defects))];
        dirty.description += std::string(", ") + defect.name;
        defect.apply(dirty.mesh, random);
    }
    if (random.below(5) == 0) {
        for (std::size_t f = 0; f < dirty.mesh.triangles.size(); ++f)
            dirty.mesh.face_groups.push_back(f < dirty.mesh.triangles.size() / 2 ? 0 : random.below(3));
    }
    if (random.below(5) == 0) add_attributes(dirty.mesh, random);
    if (random.below(25) == 0) make_invalid(dirty, random);
    return dirty;
}

}  // namespace faqem::soak
