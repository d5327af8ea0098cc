// Parts that share boundary edges have no gaps between them after simplification.

#include <algorithm>
#include <map>

#include "asset/gltf/source_document.hpp"
#include "faqem/bake_levels.hpp"
#include "scene/touching_parts.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// A sphere in pieces: two halves along a jagged line, one of them divided again.
Asset pieces() {
    const TriangleMesh sphere = icosphere(4);
    std::vector<TriangleMesh> meshes(3, sphere);
    for (TriangleMesh& mesh : meshes) mesh.triangles.clear();
    for (const Triangle& t : sphere.triangles) {
        const Vec3& p = sphere.positions[t[0]];
        meshes[p[0] > 0.1 ? 0 : p[1] > 0.3 ? 1 : 2].triangles.push_back(t);
    }
    Asset asset;
    for (const TriangleMesh& mesh : meshes) {
        asset.parts.push_back(part_of(mesh));
        asset.parts.back().name = "piece " + std::to_string(asset.parts.size());
    }
    return asset;
}

// The same asset with an image as its colour, which is seen from above.
Asset with_texture(Asset asset) {
    Material material;
    material.base_color_texture.image = add_texture(asset, ramp(32));
    asset.materials.push_back(material);
    for (Part& part : asset.parts) part = uv_mapped(std::move(part));
    return asset;
}

// Number of edges of all parts that have one face.
std::size_t open_edges(const Asset& asset) {
    std::map<std::array<Vec3, 2>, int> faces;
    for (const Part& part : asset.parts)
        for (const Triangle& t : part.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [a, b] = std::minmax(part.positions[t[k]], part.positions[t[(k + 1) % 3]]);
                ++faces[{a, b}];
            }
    return static_cast<std::size_t>(
        std::ranges::count(faces, 1, [](const auto& entry) { return entry.second; }));
}

void check_pieces(const Asset& result, std::size_t most_faces) {
    CHECK(open_edges(result) == 0);
    std::size_t faces = 0;
    for (std::size_t p = 0; p < 3; ++p) {
        INFO(p);
        const Part& part = result.parts.at(p);
        CHECK(part.name == "piece " + std::to_string(p + 1));
        CHECK(part.object_names.empty());
        CHECK(part.triangles.size() > most_faces / 10);
        for (const Vec3& v : part.positions) CHECK((p == 0 ? v[0] > -0.1 : v[0] < 0.3));
        faces += part.triangles.size();
    }
    CHECK(faces <= most_faces);
}

}  // namespace

TEST_CASE("meshes that share edges are simplified without gaps") {
    const Asset asset = pieces();
    REQUIRE(open_edges(asset) == 0);
    check_pieces(simplify(asset, {.target = faces(150)}).asset, 150);
    check_pieces(simplify(asset, {.target = faces(150), .preset = Preset::fast}).asset, 150);
    const Asset textured = with_texture(asset);
    for (const Bake kind : {Bake::automatic, Bake::keep})
        check_pieces(simplify(textured, {.target = faces(150), .bake = {.kind = kind}}).asset, 150);
}

TEST_CASE("levels of meshes that share edges have no gaps") {
    const std::vector<Level> levels = {faces(300), faces(100)};
    const std::vector<SimplifiedAssetLevel> made = simplify_levels(pieces(), levels, {});
    REQUIRE(made.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) check_pieces(made[i].result.asset, i == 0 ? 300 : 100);
}

TEST_CASE("meshes that share edges stay in their nodes") {
    const Asset file = from_glb(to_glb(pieces()));
    const Asset result = from_glb(to_glb(simplify(file, {.target = faces(150)}).asset));
    check_pieces(result, 150);
    CHECK(instances(result).size() == 3);
}

TEST_CASE("meshes that an animation moves apart stay apart") {
    const Asset file = from_glb(to_glb(pieces()));
    const auto joined = [&](const std::vector<Index>& animated_nodes) {
        SourceDocument document = *file.source;
        for (const Index node : animated_nodes)
            document.document["animations"][node]["channels"] = {{{"target", {{"node", node}}}}};
        Asset asset = file;
        asset.source = std::make_shared<SourceDocument>(document);
        return detail::join_touching_parts(asset, {});
    };
    REQUIRE(joined({0}));
    CHECK(joined({0})->parts[0].object_parts.empty());
    CHECK(joined({0})->parts[1].object_parts == std::vector<Index>{1, 2});
    CHECK(!joined({0, 1, 2}));
}

TEST_CASE("histories are those of single meshes") {
    const SimplifiedAsset result = simplify(pieces(), {.target = faces(150), .history = Recording::on});
    for (std::size_t p = 0; p < 3; ++p)
        CHECK(result.histories.at(p).triangles.size() == pieces().parts[p].triangles.size());
}

TEST_CASE("the report names each of the meshes that were simplified as one") {
    CHECK(simplify(pieces(), {.target = ratio(1)}).report.untouched_parts.size() == 3);
}

TEST_CASE("meshes that lie on each other stay apart") {
    const Asset asset = asset_with({part_of(grid(8)), part_of(grid(8))});
    CHECK(!detail::join_touching_parts(asset, {}));
    CHECK(detail::join_touching_parts(pieces(), {}));
}

TEST_CASE("meshes with few faces stay apart") {
    // Three components need 32 faces each.
    CHECK(detail::join_touching_parts(pieces(), {.target = faces(97)}));
    CHECK(!detail::join_touching_parts(pieces(), {.target = faces(95)}));
}
