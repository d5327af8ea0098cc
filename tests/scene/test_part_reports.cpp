// The report of a scene as the sum over its parts.

#include "faqem/report_json.hpp"
#include "scene/part_reports.hpp"
#include "support/catch.hpp"

using namespace faqem;

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
    const std::string before = to_json(sum);
    Report other = part;
    other.faces_out = 5;
    other.warnings = {"three"};
    detail::add_part_report(sum, other, "part 'b'");
    CHECK(sum.faces_out == 15);
    CHECK(to_json(sum) != before);
    detail::remove_part_report(sum, other, "part 'b'");
    CHECK(to_json(sum) == before);
}
