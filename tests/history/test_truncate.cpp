#include "faqem/truncate.hpp"

#include <sstream>
#include <string>

#include "faqem/error.hpp"
#include "faqem/levels.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/message_of.hpp"
#include "support/results.hpp"

using namespace faqem;
using test::file_bytes;

namespace {

const std::vector<Level> wanted_levels = {ratio(0.5), faces(300), faces(40)};

std::vector<SimplifiedLevel> levels_of(const TriangleMesh& mesh, Preset preset) {
    Options options{.preset = preset, .history = Recording::on};
    return simplify_levels(mesh.view(), wanted_levels, options);
}

ChainHistory chain_of(const std::vector<SimplifiedLevel>& levels) {
    std::vector<CollapseHistory> histories;
    for (const SimplifiedLevel& level : levels) histories.push_back(level.result.history);
    return join(histories);
}

ChainHistory read_chain(const std::string& text) {
    std::istringstream in(text);
    return read_chain_history(in);
}

void check_same_restored(const SimplifyResult& a, const SimplifyResult& b) {
    CHECK(a.mesh.positions == b.mesh.positions);
    CHECK(a.mesh.triangles == b.mesh.triangles);
    CHECK(a.mesh.face_groups == b.mesh.face_groups);
    CHECK(a.face_origin == b.face_origin);
    CHECK(a.report.faces_out == b.report.faces_out);
    CHECK(a.report.vertices_out == b.report.vertices_out);
    CHECK(a.report.collapses == b.report.collapses);
    CHECK(file_bytes(a.history) == file_bytes(b.history));
}

std::string chain_error(const std::string& text) {
    return testing::message_of([&] { read_chain(text); });
}

}  // namespace

TEST_CASE("truncate: a stored chain restores every level of its run") {
    const TriangleMesh mesh = test::lump(3);
    for (const Preset preset : all_presets) {
        const auto levels = levels_of(mesh, preset);
        const ChainHistory chain = read_chain(file_bytes(chain_of(levels)));
        REQUIRE(chain.level_count() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            const SimplifyResult& level = levels[i].result;
            check_same_restored(restore(truncate_to_level(chain, i)), level);
            check_same_restored(restore(truncate_to_faces(chain, level.report.faces_out)), level);
            check_same_restored(restore(truncate_to_faces(chain, level.report.target_faces)), level);
        }
    }
}

TEST_CASE("truncate: equals a separate run if the order of collapses does not depend on the target") {
    TriangleMesh mesh = test::both(test::lump(3), test::moved(test::grid(12), {5, 0, 0}));
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) mesh.face_groups.push_back(f % 7 == 0);
    for (const Preset preset : {Preset::qem, Preset::paper, Preset::stmw}) {
        const ChainHistory chain = chain_of(levels_of(mesh, preset));
        for (const std::uint64_t faces : {1500, 1000, 641, 300, 77, 40}) {
            Options options{.target = faqem::faces(static_cast<double>(faces)),
                            .preset = preset,
                            .history = Recording::on};
            check_same_restored(restore(truncate_to_faces(chain, faces)), simplify(mesh.view(), options));
        }
    }
}

TEST_CASE("truncate: between levels, the history is valid and has at most the requested face count") {
    const ChainHistory chain = chain_of(levels_of(test::lump(3), Preset::best));
    for (const std::uint64_t faces : {1279, 900, 303, 123}) {
        const CollapseHistory truncated = truncate_to_faces(chain, faces);
        validate(truncated);
        CHECK(truncated.remaining_faces.size() <= faces);
        CHECK(truncated.remaining_faces.size() + 2 > faces);
        CHECK(truncated.final_positions.empty());
    }
}

TEST_CASE("truncate: counts above the original give the original, counts below the last level that level") {
    const TriangleMesh mesh = test::lump(3);
    const ChainHistory chain = chain_of(levels_of(mesh, Preset::balanced));
    const TriangleMesh all = restore(truncate_to_faces(chain, 1'000'000)).mesh;
    CHECK(all.positions == mesh.positions);
    CHECK(all.triangles == mesh.triangles);
    CHECK(file_bytes(truncate_to_faces(chain, 4)) == file_bytes(chain.last));
}

TEST_CASE("truncate: deleted faces are not in the simplified mesh") {
    const TriangleMesh mesh =
        test::both(test::lump(3), test::moved(test::scaled(test::tetrahedron(), 0.1), {3, 0, 0}));
    Options options{.history = Recording::on};
    options.topology.prune = model_units(1);
    const auto levels = simplify_levels(mesh.view(), wanted_levels, options);
    const ChainHistory chain = read_chain(file_bytes(chain_of(levels)));
    CHECK(chain.last.deleted_faces.size() == 4);
    for (const SimplifiedLevel& level : levels)
        check_same_restored(restore(truncate_to_faces(chain, level.result.report.faces_out)), level.result);
    CHECK(truncate_to_faces(chain, 1'000'000).remaining_faces.size() == 1280);
}

TEST_CASE("truncate: several parts are truncated to the same level, and in proportion between levels") {
    const TriangleMesh large = test::lump(3), small = test::icosphere(2);
    const auto a = levels_of(large, Preset::balanced);
    Options options{.history = Recording::on};
    const auto b = simplify_levels(small.view(), {ratio(0.5), ratio(0.25), ratio(0.1)}, options);
    const std::vector<ChainHistory> parts = {chain_of(a), chain_of(b)};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto truncated =
            truncate_to_faces(parts, a[i].result.report.faces_out + b[i].result.report.faces_out);
        CHECK(file_bytes(truncated[0]) == file_bytes(a[i].result.history));
        CHECK(file_bytes(truncated[1]) == file_bytes(b[i].result.history));
    }
    const auto between = truncate_to_faces(parts, 600);
    const std::size_t faces[] = {between[0].remaining_faces.size(), between[1].remaining_faces.size()};
    CHECK(faces[0] + faces[1] <= 600);
    CHECK(faces[0] + faces[1] + 4 > 600);
    CHECK(faces[1] <= 160);
    CHECK(faces[1] >= 80);
    CHECK(file_bytes(truncate_to_faces(parts, 4)[0]) == file_bytes(a[2].result.history));
    const auto one = simplify_levels(small.view(), {ratio(0.5)}, options);
    CHECK_THROWS_AS(truncate_to_faces(std::vector<ChainHistory>{parts[0], chain_of(one)}, 100), InputError);
}

TEST_CASE("truncate: joining histories of different runs is an error") {
    const auto a = levels_of(test::lump(3), Preset::qem), b = levels_of(test::lump(3), Preset::paper);
    const std::vector<CollapseHistory> mixed = {a[0].result.history, b[1].result.history},
                                       reversed = {a[1].result.history, a[0].result.history};
    CHECK_THROWS_AS(join(mixed), InputError);
    CHECK_THROWS_AS(join(reversed), InputError);
    CHECK_THROWS_AS(join({}), InputError);
}

TEST_CASE("truncate: a single history is read as a chain of one level") {
    const auto levels = levels_of(test::lump(3), Preset::best);
    const ChainHistory chain = read_chain(file_bytes(levels[1].result.history));
    CHECK(chain.level_count() == 1);
    check_same_restored(restore(truncate_to_faces(chain, 300)), levels[1].result);
    CHECK(read_chain(file_bytes(join(std::vector<CollapseHistory>(3)))).level_count() == 3);
}

TEST_CASE("truncate: truncated and invalid files are errors") {
    const ChainHistory chain = chain_of(levels_of(test::lump(3), Preset::balanced));
    const std::string text = file_bytes(chain);
    for (std::size_t n = 0; n < text.size(); n += 1997) CHECK(chain_error(text.substr(0, n)) != "accepted");
    CHECK(chain_error("FAQEML02" + text.substr(8)) ==
          "history: header: not a collapse history, or of an unsupported version");
    ChainHistory forged = chain;
    std::swap(forged.before[0], forged.before[1]);
    CHECK(chain_error(file_bytes(forged)).find("history: level 1: must not end before") == 0);
    forged = chain;
    forged.before[0].collapses = 1'000'000;
    CHECK(chain_error(file_bytes(forged)).find("history: level 0: ") == 0);
    forged = chain;
    forged.before[1].remaining_versions[0] = chain.last.collapses[0].first;
    CHECK(chain_error(file_bytes(forged)) ==
          "history: remaining_versions[0]: version does not exist or was merged");
    forged = chain;
    forged.before[1].flips.push_back({0, 1});
    CHECK(chain_error(file_bytes(forged)).find("history: patch_begin") == 0);
}
