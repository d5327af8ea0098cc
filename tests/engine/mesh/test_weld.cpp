#include "faqem/engine/mesh/weld.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

using Indices = std::vector<Index>;

double vertex_distance(const Vec3& a, const Vec3& b) {
    const Vec3 d = test::minus(a, b);
    return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

// Brute force: each vertex is welded to the first representative within `reach`, or becomes one.
Indices naive(const std::vector<Vec3>& positions, double reach) {
    Indices result;
    for (Index v = 0; v < positions.size(); ++v) {
        Index found = v;
        for (Index w = 0; w < v && found == v; ++w) {
            if (positions[w] == positions[v]) found = result[w];
        }
        for (Index w = 0; w < v && found == v; ++w) {
            if (result[w] == w && vertex_distance(positions[v], positions[w]) <= reach) found = w;
        }
        result.push_back(found);
    }
    return result;
}

}  // namespace

TEST_CASE("welding maps equal positions, and no others, to the first vertex") {
    const double next = std::nextafter(1.0, 2.0);
    const std::vector<Vec3> all = {{1, 2, 3}, {3, 2, 1}, {1, 2, 3}, {next, 2, 3}, {3, 2, 1}, {1, 2, 3}};
    CHECK(weld_exact(all) == Indices{0, 1, 0, 3, 1, 0});
    CHECK(weld_exact({}).empty());
}

TEST_CASE("welding treats minus zero as zero") {
    const std::vector<Vec3> all = {{0, 0, 0}, {-0.0, 0, -0.0}, {1, -0.0, 0}, {1, 0, 0}};
    CHECK(weld_exact(all) == Indices{0, 0, 2, 2});
    CHECK(weld_within({{0, 0, 0}, {-0.0, 0, -0.0}}, 0) == Indices{0, 0});
    CHECK(weld_within({{-0.0, 0, 0}, {0, 0, -0.0}}, 1e-6) == Indices{0, 0});
}

TEST_CASE("the weld distance is inclusive and applies across cells and to negative coordinates") {
    // With cells of size 0.5, 0.49 and 0.51 are in different cells, as are -0.1 and 0.1.
    CHECK(weld_within({{0.49, 0, 0}, {0.51, 0, 0}}, 0.5) == Indices{0, 0});
    CHECK(weld_within({{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}, 0.5) == Indices{0, 0});
    CHECK(weld_within({{-7.26, 0, 0}, {-7.24, 0, 0}}, 0.25) == Indices{0, 0});
    CHECK(weld_within({{1, 0, 0}, {1.5, 0, 0}}, 0.5) == Indices{0, 0});
    CHECK(weld_within({{1, 0, 0}, {1.5, 0.01, 0}}, 0.5) == Indices{0, 1});
}

TEST_CASE("a chain of close vertices is not welded into one vertex") {
    CHECK(weld_within({{0, 0, 0}, {0.75, 0, 0}, {1.5, 0, 0}, {2.25, 0, 0}}, 1) == Indices{0, 0, 2, 2});
}

TEST_CASE("a vertex is welded to the first of several representatives within the distance") {
    CHECK(weld_within({{0, 0, 0}, {1.5, 0, 0}, {0.8, 0, 0}}, 1) == Indices{0, 1, 0});
    CHECK(weld_within({{1.5, 0, 0}, {0, 0, 0}, {0.2, 0, 0}, {0.8, 0, 0}}, 1) == Indices{0, 1, 1, 0});
}

TEST_CASE("a vertex at the position of a welded vertex has the same representative") {
    CHECK(weld_within({{0, 0, 0}, {0.5, 0, 0}, {0.5, 0, 0}}, 1) == Indices{0, 0, 0});
}

TEST_CASE("welding agrees with a brute-force search") {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        test::Random random(seed);
        std::vector<Vec3> positions;
        for (int i = 0; i < 300; ++i) {
            positions.push_back({random.between(-2, 2), random.between(-2, 2), random.between(-1, 1)});
            if (i % 7 == 0) positions.push_back(positions[random.below(positions.size())]);
        }
        INFO("seed " << seed);
        for (const double reach : {0.05, 0.3, 1.0, 10.0})
            CHECK(weld_within(positions, reach) == naive(positions, reach));
        CHECK(weld_exact(positions) == naive(positions, 0));
        CHECK(weld_within(positions, 0) == naive(positions, 0));
    }
}

TEST_CASE("welding supports coordinates that are huge compared with the distance") {
    CHECK(weld_within({{1e300, 0, 0}, {1e300, 0, 0}, {-1e300, 0, 0}}, 1e-10) == Indices{0, 0, 2});
    CHECK(weld_within({{1e20, 0, 0}, {2e20, 0, 0}}, 1e-6) == Indices{0, 1});
}
