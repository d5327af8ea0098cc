#include <cmath>
#include <vector>

#include "faqem/bake_levels.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// Two hilly sheets with a texture.
Asset two_hills() {
    Asset asset = textured_square(ramp(64));
    asset.parts.clear();
    for (const double height : {0.0, 1.0}) {
        asset.parts.push_back(uv_mapped(sheet(16, [height](double x, double y) {
            return Vec3{x / 16, y / 16, height + 0.05 * std::sin(x) * std::cos(0.7 * y)};
        })));
    }
    return asset;
}

// Records the phases, and checks that nothing goes back.
class Watched {
public:
    Options options(Options from) {
        from.progress = [this](Phase phase, double fraction) {
            CHECK(fraction >= 0);
            CHECK(fraction <= 1);
            if (phases_.empty() || phases_.back() != phase) {
                if (!phases_.empty()) CHECK(phases_.back() < phase);
                phases_.push_back(phase);
            } else {
                CHECK(fraction >= fraction_);
            }
            fraction_ = fraction;
            return Continue::yes;
        };
        return from;
    }
    const std::vector<Phase>& phases() const { return phases_; }
    double last() const { return fraction_; }

private:
    std::vector<Phase> phases_;
    double fraction_ = 0;
};

const std::vector<Phase> all_phases = {Phase::simplify, Phase::map, Phase::bake};

}  // namespace

TEST_CASE("an asset is simplified, mapped and baked, and progress never goes back") {
    const Asset source = two_hills();
    const Options given = GENERATE(Options{.target = ratio(0.2)}, Options{.max_error = of_diagonal(0.01)},
                                   Options{.target = ratio(0.2), .bake = {.kind = Bake::atlas}},
                                   Options{.target = ratio(0.2), .max_bytes = 6000},
                                   Options{.target = ratio(0.2), .visibility = Visibility::weighted});
    Watched watched;
    const SimplifiedAsset result = simplify(source, watched.options(given));
    CHECK(result.report.faces_out < result.report.faces_in);
    CHECK(watched.phases() == all_phases);
    CHECK(watched.last() == 1);
}

TEST_CASE("the search for the best picture simplifies and bakes, and progress never goes back") {
    Watched watched;
    const SimplifiedAsset result = simplify(two_hills(), watched.options({.max_bytes = 8000}));
    CHECK(!result.report.compared_results.empty());
    CHECK(watched.phases() == std::vector{Phase::simplify, Phase::bake});
}

TEST_CASE("levels of an asset are simplified and baked, and progress never goes back") {
    const std::vector<Level> levels = {ratio(0.5), of_diagonal(0.02), faces(60)};
    for (const LevelTextures textures : {LevelTextures::shared, LevelTextures::each}) {
        Watched watched;
        CHECK(simplify_levels(two_hills(), levels, watched.options({}), textures).size() == 3);
        CHECK(watched.phases() == std::vector{Phase::simplify, Phase::bake});
        CHECK(watched.last() == 1);
    }
}
