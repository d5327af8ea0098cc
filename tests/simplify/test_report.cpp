#include "faqem/report_json.hpp"

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "faqem/error.hpp"
#include "support/catch.hpp"

using namespace faqem;

TEST_CASE("preset_named finds every preset by its name and refuses other names") {
    for (const Preset preset : all_presets) CHECK(preset_named(name(preset)) == preset);
    CHECK(name(Preset::paper) == "paper");
    CHECK_THROWS_AS(preset_named("Paper"), OptionError);
    CHECK_THROWS_WITH(preset_named(""), StartsWith("unknown preset '' (known: qem, paper, stmw"));
}

TEST_CASE("refusals and rungs have distinct names") {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < refusal_kinds; ++i) names.insert(name(static_cast<Refusal>(i)));
    CHECK(names.size() == refusal_kinds);
    names.clear();
    for (std::size_t i = 0; i < rung_kinds; ++i) names.insert(name(static_cast<Rung>(i)));
    CHECK(names.size() == rung_kinds);
    CHECK(names.count("") == 0);
    CHECK(name(Refusal::zero_length) == "zero_length");
    CHECK(name(Refusal::flip) == "flip");
    CHECK(name(Refusal::seam) == "seam");
    CHECK(name(Refusal::group) == "group");
    CHECK(name(Rung::any_component) == "any_component");
    CHECK(name(StopReason::no_legal_collapse) == "no_legal_collapse");
}

TEST_CASE("the JSON report contains every count") {
    Report report;
    report.preset = Preset::stmw;
    report.faces_in = 1'000'000'007;
    report.faces_out = 2;
    report.vertices_in = 3;
    report.vertices_out = 4;
    report.target_faces = 5;
    report.stop = StopReason::cancelled;
    report.collapses = 6;
    report.refusals[static_cast<std::size_t>(Refusal::link)] = 7;
    report.rungs[static_cast<std::size_t>(Rung::without_link)] = 8;
    report.faces_dropped = 9;
    report.components_deleted = 10;
    report.virtual_edges = 11;
    report.components_pruned = 12;
    report.faces_pruned = 13;
    report.vertices_hidden = 14;
    report.pages = {{"paint", Bake::atlas, 512, 256, 90, 7, 2, 0.5, 0.75, 1.25, {30, 20, 10}, 5}};
    report.warnings = {"a \"quoted\" line\n"};
    report.seconds.weld = 0.25;
    const auto json = nlohmann::json::parse(to_json(report));
    CHECK(json["pages"].size() == 1);
    CHECK(json["pages"][0] ==
          nlohmann::json{{"material", "paint"},
                         {"kind", "atlas"},
                         {"width", 512},
                         {"height", 256},
                         {"faces", 90},
                         {"charts", 7},
                         {"faces_outside_charts", 2},
                         {"fill", 0.5},
                         {"density", 0.75},
                         {"stretch", 1.25},
                         {"samples", {{"history", 30}, {"approximate", 20}, {"closest", 10}}},
                         {"uncertain_texels", 5}});
    const auto counts = nlohmann::json::parse(R"({"preset": "stmw", "stop_reason": "cancelled",
        "faces_in": 1000000007, "faces_out": 2, "vertices_in": 3, "vertices_out": 4, "target_faces": 5,
        "collapses": 6, "faces_dropped": 9, "components_deleted": 10, "virtual_edges": 11,
        "components_pruned": 12, "faces_pruned": 13, "vertices_hidden": 14})");
    for (const auto& [key, value] : counts.items()) {
        CAPTURE(key);
        CHECK(json[key] == value);
    }
    CHECK(json["refusals"]["link"] == 7);
    CHECK(json["refusals"].size() == refusal_kinds);
    CHECK(json["rungs"]["without_link"] == 8);
    CHECK(json["rungs"].size() == rung_kinds);
    CHECK(json["warnings"][0] == "a \"quoted\" line\n");
    CHECK(json["seconds"]["weld"] == 0.25);
    CHECK(json["peak_rss_bytes"] > 0);
    CHECK(!json.contains("max_error"));
}

TEST_CASE("the JSON report contains the measured error if there is one") {
    Report report;
    report.stop = StopReason::reached_max_error;
    report.max_error = {.allowed = 0.5, .value = 0.25, .bound = 0.375, .runs = 7};
    auto json = nlohmann::json::parse(to_json(report));
    CHECK(json["stop_reason"] == "reached_max_error");
    CHECK(json["max_error"] ==
          nlohmann::json{{"allowed", 0.5}, {"value", 0.25}, {"bound", 0.375}, {"runs", 7}, {"within", true}});
    report.max_error->bound = std::numeric_limits<double>::infinity();
    json = nlohmann::json::parse(to_json(report));
    CHECK(json["max_error"]["bound"].is_null());
    CHECK(json["max_error"]["within"] == false);
    report.max_error->bound = std::numeric_limits<double>::quiet_NaN();
    CHECK(!report.max_error->within());
}

TEST_CASE("the JSON report replaces invalid UTF-8 in warnings") {
    Report report;
    report.warnings = {"file \xff.obj"};
    CHECK(nlohmann::json::parse(to_json(report))["warnings"][0] == "file \xEF\xBF\xBD.obj");
}
