// The report of a scene as the sum over its parts.

#include <string>

#include "faqem/report_json.hpp"
#include "scene/part_reports.hpp"
#include "support/catch.hpp"

using namespace faqem;

namespace {

// The report as text, without the memory of the process, which may grow meanwhile.
std::string text_of(const Report& report) {
    const std::string text = to_json(report);
    const std::size_t begin = text.find("\"peak_rss_bytes\"");
    REQUIRE(begin != std::string::npos);
    return text.substr(0, begin) + text.substr(text.find_first_of(",}", begin));
}

}  // namespace

TEST_CASE("part reports: a part that is added and removed leaves the sum as it was") {
    Report part;
    part.faces_in = 100;
    part.faces_out = 10;
    part.vertices_in = 60;
    part.vertices_out = 7;
    part.target_faces = 12;
    part.collapses = 53;
    part.refusals.fill(3);
    part.rungs.fill(1);
    part.faces_dropped = part.components_collapsed = part.components_deleted = part.components_pruned = 2;
    part.faces_pruned = part.vertices_fitted = part.edges_flipped = part.virtual_edges = 4;
    part.warnings = {"one", "two"};
    Report sum;
    detail::add_part_report(sum, part, "part 'a'");
    CHECK(sum.warnings == std::vector<std::string>{"part 'a': one", "part 'a': two"});
    CHECK(sum.target_faces == 12);
    const std::string before = text_of(sum);
    Report other = part;
    other.faces_out = 5;
    other.warnings = {"three"};
    detail::add_part_report(sum, other, "part 'b'");
    CHECK(sum.faces_out == 15);
    CHECK(text_of(sum) != before);
    detail::remove_part_report(sum, other, "part 'b'");
    CHECK(text_of(sum) == before);
}

TEST_CASE(
    "part reports: another simplification of a part replaces its counts, but not the target of the whole") {
    Report first, second, sum;
    first.faces_in = second.faces_in = 100;
    first.faces_out = 12, second.faces_out = 11;
    first.target_faces = 12, second.target_faces = 11;
    second.warnings = {"two"};
    detail::add_part_report(sum, first, "part 'a'");
    detail::replace_part_report(sum, first, second, "part 'a'");
    CHECK(sum.faces_in == 100);
    CHECK(sum.faces_out == 11);
    CHECK(sum.target_faces == 12);
    CHECK(sum.warnings == std::vector<std::string>{"part 'a': two"});
}
