#include "bake/source/facets.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

// A plate of n x n squares of side 1, in two materials by the given function.
template <class MaterialOf>
Part plate(Index n, const MaterialOf& material_of) {
    Part part = test::part_of(test::grid(n));
    for (Index f = 0; f < 2 * n * n; ++f) part.face_material[f] = material_of(f / 2 % n, f / 2 / n);
    return part;
}

bool always(const SurfacePoint&, const SurfacePoint&) { return true; }
bool never(const SurfacePoint&, const SurfacePoint&) { return false; }

}  // namespace

TEST_CASE("colour regions: five texels lie across a strip") {
    // Strips of width 2, the outer ones with one border only.
    const Part part = plate(8, [](Index x, Index) { return x / 2 % 2; });
    const std::vector<float> densities = region_densities(part, always);
    REQUIRE(densities.size() == part.triangles.size());
    CHECK(densities[2 * 3] == Approx(5 / 2.0));
    CHECK(densities[2 * 0] == Approx(5 / 4.0));
}

TEST_CASE("colour regions: a square has ten texels along its side") {
    const Part part = plate(7, [](Index x, Index y) { return x == 3 && y == 3 ? 1 : 0; });
    CHECK(region_densities(part, always)[2 * (3 * 7 + 3)] == Approx(10));
}

TEST_CASE("colour regions: materials of the same appearance are one region") {
    const Part part = plate(4, [](Index x, Index) { return x % 2; });
    CHECK(region_densities(part, never).empty());
}
