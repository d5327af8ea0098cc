#include <string>

#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/results.hpp"

using namespace tool_test;

TEST_CASE("a model of which nothing is left exits with 3 and is not written") {
    const Folder folder;
    write(folder / "point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    const auto refused = [&](const std::string& arguments, const std::string& input) {
        CAPTURE(arguments);
        const Outcome outcome = run(folder, arguments);
        CHECK(outcome.code == 3);
        CHECK(outcome.err.find("faqem: nothing is left of " + input + "; ") != std::string::npos);
        CHECK(outcome.err.find(" was not written\n") != std::string::npos);
    };
    refused("simplify point.obj out.glb --report r.json --history h.bin", "point.obj");
    refused("simplify point.obj out.ply --max-error 1", "point.obj");
    refused("simplify point.obj out.ply --max-bytes 1MB", "point.obj");
    refused("lod point.obj levels", "point.obj");
    refused("lod point.obj levels.glb --textures shared", "point.obj");
    CHECK(read(folder / "r.json").find("\"faces_out\": 0") != std::string::npos);
    for (const char* file :
         {"out.glb", "out.ply", "h.bin", "levels/point_LOD.json", "levels/point_LOD0.glb"}) {
        CAPTURE(file);
        CHECK(!fs::exists(folder / file));
    }
    faqem::Options options;
    options.history = faqem::Recording::on;
    const std::vector<faqem::Vec3> positions(3, {1, 1, 1});
    const std::vector<faqem::Triangle> triangles = {{0, 1, 2}};
    const faqem::SimplifyResult empty = faqem::simplify({positions, triangles}, options);
    REQUIRE(empty.mesh.triangles.empty());
    write(folder / "empty.bin", faqem::test::file_bytes(empty.history));
    refused("truncate empty.bin out.glb --faces 10", "empty.bin");
    faqem::save(sheet(4), folder / "sheet.glb");
    refused("simplify sheet.glb out.glb --weld 100", "sheet.glb");
}
