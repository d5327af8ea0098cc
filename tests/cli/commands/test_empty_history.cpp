#include <fstream>
#include <vector>

#include "faqem/history.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

TEST_CASE("truncate exits with 3 for a history of which nothing is left") {
    const Folder folder;
    const std::vector<faqem::Vec3> positions(3, {1, 1, 1});
    const std::vector<faqem::Triangle> triangles = {{0, 1, 2}};
    faqem::Options options;
    options.history = faqem::Recording::on;
    const faqem::SimplifyResult empty = faqem::simplify({positions, triangles}, options);
    REQUIRE(empty.mesh.triangles.empty());
    std::ofstream history(folder / "empty.bin", std::ios::binary);
    faqem::write(empty.history, history);
    history.close();
    const Outcome outcome = run(folder, "truncate empty.bin out.glb --faces 10");
    CHECK(outcome.code == 3);
    CHECK_THAT(outcome.err, ContainsSubstring("faqem: nothing is left of empty.bin; "));
    CHECK_THAT(outcome.err, ContainsSubstring(" was not written\n"));
    CHECK_FALSE(fs::exists(folder / "out.glb"));
}
