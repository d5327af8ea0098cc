#include "faqem/detail/simplify/presets.hpp"

#include "faqem/options.hpp"
#include "support/catch.hpp"

using namespace faqem;
using engine::AreaTerm;
using engine::BaseWeight;

namespace {

detail::Settings of(Preset preset, const Weights& weights = {}, const Topology& topology = {}) {
    return detail::settings({.preset = preset, .weights = weights, .topology = topology});
}

}  // namespace

TEST_CASE("preset paper has the weights of Table 1 at a diagonal of 100") {
    const detail::Settings s = of(Preset::paper);
    CHECK(s.weights.base == BaseWeight::inverse_area);
    CHECK(s.weights.plane_area == 1);
    CHECK(s.weights.area == 100);
    CHECK(s.weights.boundary == 500);
    CHECK(s.weights.normal == 0.01);
    CHECK(s.weights.seam == 5000);
    CHECK(s.weights.area_term == AreaTerm::after_placement);
    CHECK(s.weights.min_area > 0);
    CHECK(s.link == LinkCondition::off);
    CHECK(s.min_normal_cosine == 0);
    CHECK(s.diagonal == 100);
    CHECK(s.weld_distance == 1e-6);
}

TEST_CASE("preset qem has unweighted plane quadrics and the link condition") {
    const detail::Settings s = of(Preset::qem);
    CHECK(s.weights.base == BaseWeight::unit);
    CHECK(s.weights.area == 0);
    CHECK(s.weights.boundary == 0);
    CHECK(s.weights.normal == 0);
    CHECK(s.weights.seam == 1);
    CHECK(s.link == LinkCondition::on);
    CHECK(s.min_normal_cosine == 0);
    CHECK(s.diagonal == 1);
    CHECK(s.weld_distance == 0);
}

TEST_CASE("preset fast is memoryless and preset balanced also tracks distances") {
    CHECK(of(Preset::fast).quadric_policy == detail::Settings::QuadricPolicy::memoryless);
    const detail::Settings s = of(Preset::balanced);
    CHECK(s.quadric_policy == detail::Settings::QuadricPolicy::tracked);
    CHECK(s.link == LinkCondition::by_size);
    CHECK(s.min_normal_cosine == 0.3);
    CHECK(s.diagonal == 1);
    CHECK(detail::settings({}).quadric_policy == detail::Settings::QuadricPolicy::tracked);
}

TEST_CASE("preset stmw weights planes by area and uses the area term for placement") {
    const detail::Settings s = of(Preset::stmw);
    CHECK(s.weights.base == BaseWeight::area);
    CHECK(s.weights.area == 1);
    CHECK(s.weights.boundary == 0);
    CHECK(s.weights.normal == 0);
    CHECK(s.weights.area_term == AreaTerm::before_placement);
    CHECK(s.link == LinkCondition::off);
    CHECK(s.diagonal == 1);
    CHECK(s.weld_distance == 0);
}

TEST_CASE("every weight and topology option overrides the preset") {
    Weights w{.area = 1, .boundary = 2, .normal = 3, .uv = 4, .plane_area = 5};
    Topology t{.link = LinkCondition::on, .weld_distance = 6};
    for (const Preset preset : {Preset::qem, Preset::paper, Preset::stmw}) {
        const detail::Settings s = of(preset, w, t);
        CHECK(s.weights.area == 1);
        CHECK(s.weights.boundary == 2);
        CHECK(s.weights.normal == 3);
        CHECK(s.weights.seam == 4);
        CHECK(s.weights.plane_area == 5);
        CHECK(s.weights.base == BaseWeight::inverse_area);
        CHECK(s.link == LinkCondition::on);
        CHECK(s.weld_distance == 6);
    }
    t.link = LinkCondition::off;
    CHECK(of(Preset::qem, {}, t).link == LinkCondition::off);
}

TEST_CASE("the link condition by_size applies to memoryless presets and is on for others") {
    for (const Preset preset : all_presets) {
        Options o{.preset = preset, .topology = {.link = LinkCondition::by_size}};
        const detail::Settings s = detail::settings(o);
        const bool has_memory = s.quadric_policy == detail::Settings::QuadricPolicy::memory;
        CHECK(s.link == (has_memory ? LinkCondition::on : LinkCondition::by_size));
    }
}

TEST_CASE("plane_area 0 gives unweighted planes as in the ablation of the paper") {
    CHECK(of(Preset::paper, {.plane_area = 0}).weights.base == BaseWeight::unit);
}
