// Order of triangles and vertices in glTF files (FileOrder::for_gpu).

#include <algorithm>
#include <set>

#include "support/catch.hpp"
#include "support/gltf_builder.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// A grid of 2 * n * n triangles in a pseudo-random order, with all attributes.
Asset shuffled_grid(Index n) {
    const TriangleMesh grid = test::grid(n);
    Asset asset = one_part(grid.positions, grid.triangles);
    Part& part = asset.parts[0];
    part.uvs.resize(2);
    part.morph_targets.resize(1);
    for (Index i = 0; i < (n + 1) * (n + 1); ++i) {
        const float x = static_cast<float>(i % (n + 1)), y = static_cast<float>(i / (n + 1));
        part.normals.push_back(i % 2 ? Vec3f{0, 0, 1} : Vec3f{0, 1, 0});
        part.tangents.push_back({1, 0, 0, i % 3 ? 1.0f : -1.0f});
        part.uvs[0].push_back({x / 64, y / 64});
        part.uvs[1].push_back({y, x});
        part.colors.push_back({x / 64, y / 64, 0, 1});
        part.joints.push_back({static_cast<std::uint16_t>(i), 0, 0, 0});
        part.weights.push_back({1, 0, 0, 0});
        part.morph_targets[0].positions.push_back({y, 0, x});
    }
    std::uint32_t random = 1;
    for (std::size_t i = part.triangles.size(); i > 1; --i) {
        random = random * 1664525u + 1013904223u;
        std::swap(part.triangles[i - 1], part.triangles[(random >> 8) % i]);
    }
    return asset;
}

/// The triangles with all attributes of their corners, beginning with their least corner.
std::multiset<std::vector<double>> triangles_with_attributes(const Part& part) {
    std::multiset<std::vector<double>> result;
    for (const Triangle& t : part.triangles) {
        std::array<std::vector<double>, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto add = [&](const auto& values) {
                if (!values.empty())
                    corners[c].insert(corners[c].end(), values[t[c]].begin(), values[t[c]].end());
            };
            add(part.positions);
            add(part.normals);
            add(part.tangents);
            for (const auto& uvs : part.uvs) add(uvs);
            add(part.colors);
            add(part.joints);
            add(part.weights);
            for (const MorphTarget& target : part.morph_targets) add(target.positions);
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        std::vector<double>& all = corners[0];
        for (std::size_t c = 1; c < 3; ++c) all.insert(all.end(), corners[c].begin(), corners[c].end());
        result.insert(std::move(all));
    }
    return result;
}

Part written_and_read(Asset asset, FileOrder order) {
    asset.parts[0].file_order = order;
    return load_glb(saved(asset)).parts.at(0);
}

/// Misses per triangle of a cache that holds the last 16 vertices (first in, first out).
double cache_miss_ratio(const Part& part) {
    std::vector<Index> cache;
    for (const Triangle& t : part.triangles)
        for (const Index v : t) {
            const auto begin = cache.size() > 16 ? cache.end() - 16 : cache.begin();
            if (std::find(begin, cache.end(), v) == cache.end()) cache.push_back(v);
        }
    return static_cast<double>(cache.size()) / static_cast<double>(part.triangles.size());
}

}  // namespace

TEST_CASE("GPU order: the triangles and their attributes stay the same") {
    Asset asset = shuffled_grid(12);
    const Part given = written_and_read(asset, FileOrder::given);
    const Part ordered = written_and_read(asset, FileOrder::for_gpu);
    CHECK(given.triangles == asset.parts[0].triangles);
    CHECK(given.positions == asset.parts[0].positions);
    CHECK(ordered.positions.size() == given.positions.size());
    const bool equal = triangles_with_attributes(ordered) == triangles_with_attributes(given);
    CHECK(equal);
}

TEST_CASE("GPU order: each material has a primitive with the same triangles") {
    Asset asset = shuffled_grid(6);
    Part& part = asset.parts[0];
    asset.materials.resize(2);
    for (Index f = 0; f < part.face_material.size(); ++f) part.face_material[f] = f % 3 == 0 ? 1 : 0;
    Part given = written_and_read(asset, FileOrder::given);
    Part ordered = written_and_read(asset, FileOrder::for_gpu);
    for (const Index material : {0u, 1u}) {
        Part of_material[2] = {given, ordered};
        for (Part& one : of_material) {
            std::vector<Triangle> triangles;
            for (Index f = 0; f < one.triangles.size(); ++f)
                if (one.face_material[f] == material) triangles.push_back(one.triangles[f]);
            one.triangles = triangles;
        }
        CHECK(of_material[0].triangles.size() == (material == 1 ? 24 : 48));
        const bool equal =
            triangles_with_attributes(of_material[0]) == triangles_with_attributes(of_material[1]);
        CHECK(equal);
    }
}

#ifdef FAQEM_WITH_MESHOPT
TEST_CASE("GPU order: triangles share cached vertices, and vertices are in the order of their first use") {
    const Asset asset = shuffled_grid(24);
    const Part ordered = written_and_read(asset, FileOrder::for_gpu);
    CHECK(cache_miss_ratio(asset.parts[0]) > 1.5);
    CHECK(cache_miss_ratio(ordered) < 0.75);  // the least possible is about 0.5
    Index next = 0;
    for (const Triangle& t : ordered.triangles)
        for (const Index v : t) {
            CHECK(v <= next);
            if (v == next) ++next;
        }
    CHECK(next == 25 * 25);
}
#else
TEST_CASE("GPU order: without meshoptimizer the order stays as it is") {
    const Asset asset = shuffled_grid(4);
    CHECK(written_and_read(asset, FileOrder::for_gpu).triangles == asset.parts[0].triangles);
}
#endif
