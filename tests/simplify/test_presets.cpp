#include "faqem/detail/simplify/presets.hpp"

#include <catch2/catch.hpp>

using namespace faqem;
using engine::AreaTerm;
using engine::BaseWeight;

namespace {

detail::Settings of(Preset preset, const Weights& weights = {}, const Topology& topology = {}) {
    Options options;
    options.preset = preset;
    options.weights = weights;
    options.topology = topology;
    return detail::settings(options);
}

}  // namespace

TEST_CASE("paper is Table 1 of the supplementary, at a diagonal of 100") {
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

TEST_CASE("qem is Garland and Heckbert's: plain planes, the link condition") {
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

TEST_CASE("fast has no memory, balanced tracks the distance besides") {
    CHECK(of(Preset::fast).quadric_policy == detail::Settings::QuadricPolicy::memoryless);
    const detail::Settings s = of(Preset::balanced);
    CHECK(s.quadric_policy == detail::Settings::QuadricPolicy::tracked);
    CHECK(s.link == LinkCondition::by_size);
    CHECK(s.min_normal_cosine == 0.3);
    CHECK(s.diagonal == 1);
    CHECK(detail::settings({}).quadric_policy == detail::Settings::QuadricPolicy::tracked);
}

TEST_CASE("stmw weighs planes by area and places with the area term") {
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

TEST_CASE("every weight and rule can be set on its own") {
    Weights w;
    w.area = 1;
    w.boundary = 2;
    w.normal = 3;
    w.uv = 4;
    w.plane_area = 5;
    Topology t;
    t.link = LinkCondition::on;
    t.weld_distance = 6;
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

TEST_CASE("the link condition by size is that of the presets without memory, elsewhere it is on") {
    for (const Preset preset : all_presets) {
        Options o;
        o.preset = preset;
        o.topology.link = LinkCondition::by_size;
        const detail::Settings s = detail::settings(o);
        const bool has_memory = s.quadric_policy == detail::Settings::QuadricPolicy::memory;
        CHECK(s.link == (has_memory ? LinkCondition::on : LinkCondition::by_size));
    }
}

TEST_CASE("plane_area 0 means unweighted planes, as in the paper's ablation") {
    Weights w;
    w.plane_area = 0;
    CHECK(of(Preset::paper, w).weights.base == BaseWeight::unit);
}
