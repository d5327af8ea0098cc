// The report of a scene as the sum over its parts.

#include <string>
#include <vector>

#include "scene/part_reports.hpp"
#include "support/catch.hpp"

using namespace faqem;

TEST_CASE("part reports: a part with UVs has its own counts and warnings, but not a target of its own") {
    Asset source;
    source.parts.resize(2);
    source.parts[0].name = "a", source.parts[1].name = "b";
    SimplifiedParts simplified;
    simplified.parts.resize(2), simplified.with_uvs.resize(2);
    for (std::size_t p = 0; p < 2; ++p) {
        Report &without = simplified.parts[p].report, &with = simplified.with_uvs[p].report;
        without.faces_in = with.faces_in = 100;
        without.target_faces = without.faces_out = 12;
        with.target_faces = with.faces_out = 11;
        without.refusals.fill(3), with.refusals.fill(5);
        without.rungs.fill(1), with.rungs.fill(0);
        without.warnings = {"one"}, with.warnings = {"two"};
        detail::add_part_report(simplified.report, without, p == 0 ? "part 'a'" : "part 'b'");
    }
    simplified.report.warnings.push_back("of the whole");
    const Report report = detail::report_with_uvs(source, simplified, std::vector<Index>{1});
    CHECK(report.faces_in == 200);
    CHECK(report.faces_out == 23);
    CHECK(report.target_faces == 24);
    CHECK(report.refusals[0] == 8);
    CHECK(report.rungs[0] == 1);
    CHECK(report.warnings == std::vector<std::string>{"part 'a': one", "of the whole", "part 'b': two"});
}
