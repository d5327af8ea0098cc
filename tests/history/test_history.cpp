#include "faqem/history.hpp"

#include <cstring>
#include <functional>
#include <limits>
#include <sstream>

#include "faqem/error.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/message_of.hpp"
#include "support/results.hpp"

using namespace faqem;
using test::file_bytes;

namespace {

// The unit square after the collapse of corners 0 and 1 into (1/2, 0, 0): face 1 is left.
CollapseHistory small() {
    CollapseHistory h;
    h.positions = test::quad().positions;
    h.triangles = test::quad().triangles;
    h.face_groups = {3, 4};
    h.collapses = {{0, 1, {0.5, 0, 0}}};
    h.patch_begin = {0, 2};
    h.patch_faces = {0, 1};
    h.remaining_versions = {4, 2, 3};
    h.remaining_faces = {1};
    return h;
}

// A history with at least one element in each array, including a deleted component.
CollapseHistory with_deleted_part() {
    CollapseHistory h = small();
    h.positions.insert(h.positions.end(), {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}});
    h.triangles.push_back({4, 5, 6});
    h.face_groups.push_back(9);
    h.remaining_versions[0] = 7;
    h.deleted_faces = {{1, 2}};
    return h;
}

// The unit square with its diagonal flipped.
CollapseHistory flipped() {
    CollapseHistory h;
    h.positions = test::quad().positions;
    h.triangles = test::quad().triangles;
    h.patch_begin = {0, 2};
    h.patch_faces = {0, 1};
    h.remaining_versions = {0, 1, 2, 3};
    h.remaining_faces = {0, 1};
    return h;
}

CollapseHistory read(const std::string& text) {
    std::istringstream in(text);
    return read_history(in);
}

// The error message of validate() for a modified history; checks that read_history() gives the same.
std::string changed(const std::function<void(CollapseHistory&)>& change) {
    CollapseHistory h = with_deleted_part();
    change(h);
    const std::string message = testing::message_of([&] { validate(h); });
    CHECK(testing::message_of([&] { read(file_bytes(h)); }) == message);
    return message;
}

bool same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
    return a.positions == b.positions && a.triangles == b.triangles && a.face_groups == b.face_groups;
}

}  // namespace

TEST_CASE("history: positions of versions and faces of patches") {
    const CollapseHistory h = small();
    CHECK(h.position(2) == Vec3{1, 1, 0});
    CHECK(h.position(4) == Vec3{0.5, 0, 0});
    CHECK(h.patch(0).size() == 2);
    CHECK_FALSE(h.empty());
    CHECK(CollapseHistory().empty());
}

TEST_CASE("history: replay reconstructs the simplified mesh") {
    const TriangleMesh mesh = replay(small());
    CHECK(mesh.positions == std::vector<Vec3>{{0.5, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(mesh.face_groups == std::vector<Index>{4});
}

TEST_CASE("history: writing and reading restores the same bytes") {
    for (const CollapseHistory& h : {small(), with_deleted_part(), CollapseHistory()}) {
        const std::string text = file_bytes(h);
        const CollapseHistory again = read(text);
        CHECK(file_bytes(again) == text);
        CHECK(again.positions == h.positions);
        CHECK(again.triangles == h.triangles);
        CHECK(again.remaining_versions == h.remaining_versions);
        CHECK(again.collapses.size() == h.collapses.size());
        CHECK(again.deleted_faces.size() == h.deleted_faces.size());
    }
}

TEST_CASE("history: a truncated file is an error that names the section") {
    const std::string text = file_bytes(with_deleted_part());
    for (std::size_t size = 0; size < text.size(); ++size) {
        const std::string message = testing::message_of([&] { read(text.substr(0, size)); });
        if (message.find("history: ") != 0 || message.find("ends too early") == std::string::npos)
            FAIL("truncated to " << size << " bytes: " << message);
    }
    CHECK(testing::message_of([&] { read(text.substr(0, 5)); }) == "history: header: ends too early");
    CHECK(testing::message_of([&] { read(text.substr(0, 20)); }) == "history: positions: ends too early");
    CHECK(testing::message_of([&] { read(text.substr(0, text.size() - 1)); }) ==
          "history: remaining_faces: ends too early");
}

TEST_CASE("history: a file of another format is an error") {
    CHECK(testing::message_of([] { read("glTF............"); }) ==
          "history: header: not a collapse history, or of an unsupported version");
}

TEST_CASE("history: an invalid element count does not allocate memory") {
    // Each count in turn is set to 2^60 and 2^64 - 1; allocating that much would throw bad_alloc or
    // length_error.
    const std::string text = file_bytes(with_deleted_part());
    const std::uint64_t elements[] = {24, 12, 4, 4, 4, 24, 8, 4, 24, 8, 4, 4, 4};
    std::size_t at = 8;
    for (const std::uint64_t size : elements) {
        std::uint64_t count = 0;
        std::memcpy(&count, &text[at], sizeof count);
        for (const std::uint64_t invalid : {std::uint64_t{1} << 60, ~std::uint64_t{0}, count + 1}) {
            std::string forged = text;
            std::memcpy(&forged[at], &invalid, sizeof invalid);
            CHECK(testing::message_of([&] { read(forged); }) != "accepted");
        }
        at += 8 + count * size;
    }
    CHECK(at == text.size());
}

TEST_CASE("history: final positions are written and read, and a wrong number of them is an error") {
    CollapseHistory history = with_deleted_part();
    for (std::size_t i = 0; i < history.remaining_versions.size(); ++i) {
        history.final_positions.push_back({1.0 + i, 2, 3});
    }
    std::istringstream in(file_bytes(history));
    const CollapseHistory again = read_history(in);
    CHECK(again.final_positions == history.final_positions);
    CHECK(replay(again).positions == history.final_positions);
    history.final_positions.pop_back();
    CHECK(testing::message_of([&] { validate(history); }) ==
          "history: final_positions: needs one entry per remaining version or none");
}

TEST_CASE("history: edge flips are written, read and replayed") {
    CollapseHistory history = flipped();
    const TriangleMesh mesh = replay(read(file_bytes(history)));
    //  3---2        3---2
    //  | / |   ->   | \ |
    //  0---1        0---1
    CHECK(mesh.triangles == std::vector<Triangle>{{2, 3, 1}, {0, 1, 3}});
    history.patch_faces.insert(history.patch_faces.end(), {1, 0});
    history.patch_begin.push_back(4);
    validate(history);
    CHECK(replay(history).triangles == std::vector<Triangle>{{3, 0, 2}, {1, 2, 0}});
}

TEST_CASE("history: an edge flip needs two remaining faces with a common edge") {
    CollapseHistory history = flipped();
    history.patch_faces = {0, 0};
    CHECK(testing::message_of([&] { validate(history); }) ==
          "history: patch_begin[0]: faces of an edge flip must remain and share an edge");
    history.patch_faces = {0};
    history.patch_begin = {0, 1};
    CHECK(testing::message_of([&] { validate(history); }) ==
          "history: patch_begin[0]: an edge flip must have two faces");
    history = small();  // face 0 is not in the simplified mesh
    history.patch_faces.insert(history.patch_faces.end(), {0, 1});
    history.patch_begin.push_back(4);
    CHECK(testing::message_of([&] { validate(history); }) ==
          "history: patch_begin[1]: faces of an edge flip must remain and share an edge");
}

TEST_CASE("history: arrays of different lengths are an error, also empty ones") {
    const std::string text = file_bytes(with_deleted_part());
    // From the end: remaining_faces 1, remaining_versions 3, deleted faces 1, their times 1.
    const std::size_t times = text.size() - (8 + 4) - (8 + 12) - (8 + 4) - (8 + 8);
    std::string forged = text;
    forged.erase(times + 8, 8);
    forged[times] = 0;
    CHECK(testing::message_of([&] { read(forged); }) ==
          "history: deleted_faces: arrays have different lengths");
    forged = text;
    forged.erase(times + 24, 4);
    forged[times + 16] = 0;
    CHECK(testing::message_of([&] { read(forged); }) ==
          "history: deleted_faces: arrays have different lengths");
}

TEST_CASE("history: invalid indices are errors that name the first invalid element") {
    using H = CollapseHistory;
    CHECK(changed([](H&) {}) == "accepted");
    CHECK(changed([](H& h) { h.triangles[1][2] = 7; }) == "history: triangles[1]: vertex index out of range");
    CHECK(changed([](H& h) { h.triangles[1][2] = no_index; }) ==
          "history: triangles[1]: vertex index out of range");
    CHECK(changed([](H& h) { h.face_groups.pop_back(); }) ==
          "history: face_groups: needs one entry per face or none");
    CHECK(changed([](H& h) { h.collapses[0].second = 7; }) ==
          "history: collapses[0]: version does not exist yet");
    CHECK(changed([](H& h) { h.collapses[0].first = no_index; }) ==
          "history: collapses[0]: version does not exist yet");
    CHECK(changed([](H& h) { h.collapses[0].second = 0; }) ==
          "history: collapses[0]: version was already merged");
    CHECK(changed([](H& h) {
              h.collapses.push_back({1, 2, {}});
              h.patch_begin.push_back(2);
          }) == "history: collapses[1]: version was already merged");
    for (const std::vector<std::uint64_t>& bad :
         {std::vector<std::uint64_t>{}, {0}, {0, 1}, {1, 2}, {0, 3}, {0, 2, 1}, {0, ~0ull}}) {
        CHECK(changed([&](H& h) { h.patch_begin = bad; }) ==
              "history: patch_begin: must increase from 0 to the number of patch faces");
    }
    CHECK(changed([](H& h) {
              h.collapses.push_back({2, 3, {}});
              h.patch_begin = {0, 3, 2};
          }) == "history: patch_begin: must increase from 0 to the number of patch faces");
    CHECK(changed([](H& h) { h.patch_faces[1] = 3; }) == "history: patch_faces[1]: face does not exist");
    CHECK(changed([](H& h) { h.deleted_faces[0].face = 3; }) ==
          "history: deleted_faces[0]: time or face index out of range");
    CHECK(changed([](H& h) { h.deleted_faces[0].time = 2; }) ==
          "history: deleted_faces[0]: time or face index out of range");
    CHECK(changed([](H& h) { h.remaining_versions[1] = 8; }) ==
          "history: remaining_versions[1]: version does not exist or was merged");
    CHECK(changed([](H& h) { h.remaining_versions[1] = 0; }) ==
          "history: remaining_versions[1]: version does not exist or was merged");
    CHECK(changed([](H& h) { h.remaining_faces[0] = 3; }) ==
          "history: remaining_faces[0]: face does not exist");
    CHECK(changed([](H& h) { h.remaining_faces[0] = 2; }) ==
          "history: remaining_faces[0]: refers to a vertex that is not in the simplified mesh");
    CHECK(changed([](H& h) { h.triangles[0].fill(no_index); }) ==
          "history: patch_faces[0]: face does not exist");
}

TEST_CASE("history: positions that are not finite are errors in all arrays") {
    using H = CollapseHistory;
    const double infinite = std::numeric_limits<double>::infinity(), nan = std::nan("");
    CHECK(changed([&](H& h) { h.positions[1][2] = infinite; }) ==
          "history: positions[1]: position is not finite");
    CHECK(changed([&](H& h) { h.collapses[0].position[0] = nan; }) ==
          "history: collapses[0]: position is not finite");
    CHECK(changed([&](H& h) {
              h.final_positions.assign(h.remaining_versions.size(), {0, -infinite, 0});
          }) == "history: final_positions[0]: position is not finite");
}

TEST_CASE("history: an empty history must not have elements that refer to others") {
    using H = CollapseHistory;
    const auto empty_but = [](const std::function<void(H&)>& change) {
        H h;
        change(h);
        return testing::message_of([&] { validate(h); });
    };
    CHECK(empty_but([](H&) {}) == "accepted");
    CHECK(empty_but([](H& h) { h.remaining_versions = {5}; }) != "accepted");
    CHECK(empty_but([](H& h) { h.remaining_faces = {0}; }) != "accepted");
    CHECK(empty_but([](H& h) { h.collapses = {{0, 1, {}}}; }) != "accepted");
    CHECK(empty_but([](H& h) { h.patch_faces = {0}; }) != "accepted");
    CHECK(empty_but([](H& h) { h.deleted_faces = {{0, 0}}; }) != "accepted");
}

TEST_CASE("history: random byte errors give an InputError or a valid mesh") {
    const auto result = simplify(test::shaken(test::icosphere(1), 0.05, 1).view(),
                                 {.target = ratio(0.4), .preset = Preset::qem, .history = Recording::on});
    const std::string text = file_bytes(result.history);
    test::Random random(9);
    std::size_t refused = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string damaged = text;
        for (int i = 0; i < 1 + round % 3; ++i)
            damaged[8 + random.below(text.size() - 8)] = static_cast<char>(random.below(256));
        try {
            const TriangleMesh mesh = replay(read(damaged));
            for (const Triangle& t : mesh.triangles) {
                for (const Index v : t) REQUIRE(v < mesh.positions.size());
            }
        } catch (const InputError&) {
            ++refused;
        }
    }
    CHECK(refused > 100);
}

TEST_CASE("history: the history of a run replays to its result, also after writing and reading") {
    const TriangleMesh sphere = test::shaken(test::icosphere(2), 0.03, 1);
    TriangleMesh parts = test::both(test::grid(5), test::moved(test::cylinder(9, 3, 2), {7, 0, 0}));
    parts = test::both(parts, test::moved(test::scaled(test::tetrahedron(), 1e-3), {0, 0, 3}));
    for (Index f = 0; f < parts.triangles.size(); ++f) parts.face_groups.push_back(f % 2);
    for (const TriangleMesh& mesh : {sphere, parts, test::soup(4, 30, 100)}) {
        for (const Preset preset : all_presets) {
            for (const double share : {1.0, 0.5, 0.05}) {
                INFO(int(preset) << " " << share);
                Options options{.target = ratio(share), .preset = preset, .history = Recording::on};
                const SimplifyResult result = simplify(mesh.view(), options);
                validate(result.history);
                CHECK(same_mesh(replay(result.history), result.mesh));
                CHECK(same_mesh(replay(read(file_bytes(result.history))), result.mesh));
                CHECK(result.history.collapses.size() == result.report.collapses);
                CHECK(result.history.remaining_faces == result.face_origin);
            }
        }
    }
}

TEST_CASE("history: a failing stream is a WriteError") {
    std::ostringstream out;
    out.setstate(std::ios::badbit);
    CHECK_THROWS_AS(write(small(), out), WriteError);
}
