#include "bake/parts/vertex_attributes.hpp"

#include <cmath>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;

namespace {

constexpr std::uint32_t u16 = 5123, f32 = 5126;

// A wavy sheet of 800 faces in two halves with vertices of their own: feature 7 for x < 10, 9 beyond. `_HEIGHT` is x
// + 2 y.
Part two_features() {
    Part part = test::sheet(20, [](double x, double y) {
        return Vec3{x, y, std::sin(0.4 * x) + std::cos(0.5 * y)};
    });
    part.face_material.clear();
    std::vector<Index> twin(part.positions.size(), no_index);
    for (Triangle& t : part.triangles) {
        double x = 0;
        for (const Index v : t) x += part.positions[v][0] / 3;
        if (x < 10) continue;
        for (Index& v : t) {
            if (part.positions[v][0] != 10) continue;
            if (twin[v] == no_index) {
                twin[v] = static_cast<Index>(part.positions.size());
                part.positions.push_back(part.positions[v]);
            }
            v = twin[v];
        }
    }
    CustomAttribute id{"_FEATURE_ID_0", {}, 1, u16}, batch{"_BATCHID", {}, 1, f32},
        height{"_HEIGHT", {}, 2, f32};
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
        const Vec3& p = part.positions[v];
        const bool is_right = p[0] > 10 || v >= 21 * 21;
        id.values.push_back({is_right ? 9.0 : 7.0, 0, 0, 0});
        batch.values.push_back(id.values.back());
        height.values.push_back({p[0] + 2 * p[1], 5, 0, 0});
    }
    part.custom_attributes = {id, batch, height};
    return part;
}

}  // namespace

TEST_CASE("feature ids are copied to each side of a border, and floats interpolated") {
    Asset asset;
    asset.parts = {two_features()};
    Options options{.target = ratio(0.2)};
    options.bake.kind = GENERATE(Bake::automatic, Bake::keep, Bake::none);
    const SimplifiedAsset result = simplify(asset, options);
    const Part& part = result.asset.parts[0];
    REQUIRE(part.triangles.size() <= 160);
    REQUIRE(part.custom_attributes.size() == 3);
    const CustomAttribute &id = part.custom_attributes[0], &batch = part.custom_attributes[1],
                          &height = part.custom_attributes[2];
    CHECK(id.component_type == u16);
    CHECK(height.components == 2);
    REQUIRE(id.values.size() == part.positions.size());
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
        const Vec3& p = part.positions[v];
        CHECK((id.values[v][0] == 7 || id.values[v][0] == 9));
        CHECK(id.values[v] == batch.values[v]);
        if (std::abs(p[0] - 10) > 1.5) CHECK(id.values[v][0] == (p[0] < 10 ? 7 : 9));
        CHECK(std::abs(height.values[v][0] - (p[0] + 2 * p[1])) < 1.5);
        CHECK(height.values[v][1] == Approx(5));
    }
}

TEST_CASE("custom attributes of a wrong length are rejected") {
    Asset asset;
    asset.parts = {two_features()};
    asset.parts[0].custom_attributes[1].values.pop_back();
    CHECK_THROWS_AS(simplify_parts(asset, {}), InputError);
}
