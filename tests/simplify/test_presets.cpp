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

TEST_CASE("presets with memory have the weights of their publications") {
    struct Row {
        Preset preset;
        BaseWeight base;
        double area, boundary, normal, seam;
        AreaTerm area_term;
        LinkCondition link;
        double diagonal, weld_distance;
    };
    // That of `paper` is Table 1.
    for (const Row& row :
         {Row{Preset::qem, BaseWeight::unit, 0, 0, 0, 1, AreaTerm::after_placement, LinkCondition::on, 1, 0},
          {Preset::paper, BaseWeight::inverse_area, 100, 500, 0.01, 5000, AreaTerm::after_placement,
           LinkCondition::off, 100, 1e-6},
          {Preset::stmw, BaseWeight::area, 1, 0, 0, 1, AreaTerm::before_placement, LinkCondition::off, 1,
           0}}) {
        CAPTURE(name(row.preset));
        const detail::Settings s = of(row.preset);
        CHECK(s.weights.base == row.base);
        CHECK(s.weights.area == row.area);
        CHECK(s.weights.boundary == row.boundary);
        CHECK(s.weights.normal == row.normal);
        CHECK(s.weights.seam == row.seam);
        CHECK((row.area == 0 || s.weights.area_term == row.area_term));
        CHECK(s.link == row.link);
        CHECK(s.min_normal_cosine == 0);
        CHECK(s.diagonal == row.diagonal);
        CHECK(s.weld_distance == row.weld_distance);
    }
    CHECK(of(Preset::paper).weights.plane_area == 1);
    CHECK(of(Preset::paper).weights.min_area > 0);
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
