#include "faqem/bake_onto.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "asset/image/srgb.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

using Color = std::array<double, 3>;
constexpr Vec4f red = {1, 0, 0, 1}, blue = {0, 0, 1, 1};

/// A scene of one mesh without a material; each vertex has the colour color(position), linear.
Asset painted(const TriangleMesh& mesh, const std::function<Vec4f(const Vec3&)>& color) {
    Asset asset;
    asset.parts = {part_of(mesh)};
    for (const Vec3& p : mesh.positions) asset.parts[0].colors.push_back(color(p));
    return asset;
}
Asset painted(const TriangleMesh& mesh, const Vec4f& color) {
    return painted(mesh, [&](const Vec3&) { return color; });
}

Asset plain(const TriangleMesh& mesh) {
    Asset asset;
    asset.parts = {part_of(mesh)};
    return asset;
}

/// The scenes in one.
Asset together(Asset a, const Asset& b) {
    a.parts.insert(a.parts.end(), b.parts.begin(), b.parts.end());
    return a;
}

/// A box whose upper side is at `top` and whose lower side is at `bottom`; of both sides the vertices are separate, as is
/// the upper and the lower half of its border.
TriangleMesh plate(double bottom, double top) {
    const TriangleMesh upper = moved(grid(8), {0, 0, top}), lower = moved(grid(8), {0, 0, bottom});
    return both(upper, inside_out(lower));
}

/// Calls visit(part, face, weights, colour from 0 to 255) on all faces of a result.
void for_each_color(const Asset& baked,
                    const std::function<void(std::size_t, const Vec3&, const Color&)>& visit) {
    for (std::size_t p = 0; p < baked.parts.size(); ++p) {
        const Part& part = baked.parts[p];
        for (std::size_t f = 0; f < part.triangles.size(); ++f) {
            const Pixels pixels = base_color_image(baked, part.face_material[f]);
            for (const Vec3& w : spread(3)) {
                const auto c = look(part, pixels, f, w);
                visit(p, blend(part.positions, part.triangles[f], w), {c[0], c[1], c[2]});
            }
        }
    }
}

/// The largest difference between the colours of a result and color(position), from 0 to 255.
double worst(const Asset& baked, const std::function<Color(std::size_t part, const Vec3&)>& color) {
    double result = 0;
    for_each_color(baked, [&](std::size_t part, const Vec3& p, const Color& got) {
        const Color wanted = color(part, p);
        for (std::size_t k = 0; k < 3; ++k) result = std::max(result, std::abs(got[k] - wanted[k]));
    });
    return result;
}

Asset turned(Asset asset) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    for (Part& part : asset.parts)
        for (Vec3& p : part.positions) p = {c * p[0] - s * p[2], p[1], s * p[0] + c * p[2]};
    return asset;
}

// The colour of textured_square(ramp(256)) at a point.
Color ramp_at(const Vec3& p) {
    static const Pixels pixels = ramp(256);
    const auto c = read(pixels, p[0], 1 - p[1]);
    return {c[0], c[1], c[2]};
}

}  // namespace

TEST_CASE("a source that is baked onto itself keeps its colours, however both are turned") {
    const Asset source = textured_square(ramp(256));
    const bool turns = GENERATE(false, true);
    const SimplifiedAsset baked =
        turns ? bake_onto(turned(source), turned(source), lossless()) : bake_onto(source, source, lossless());
    const auto color = [&](std::size_t, const Vec3& p) {
        return ramp_at(turns ? Vec3{p[0] * std::cos(0.7) + p[2] * std::sin(0.7), p[1], 0} : p);
    };
    CHECK(worst(baked.asset, color) <= 1);
    CHECK(baked.report.coverage->missing_texels == 0);
    CHECK(baked.report.coverage->largest_distance < 1e-12);
    CHECK(baked.asset.parts[0].name == "square");
    CHECK(baked.report.warnings.empty());
}

TEST_CASE("a sphere is shown by one with other triangles") {
    const auto color = [](const Vec3& p) {
        return Vec4f{float(0.5 + p[0] / 4), float(0.5 + p[1] / 4), float(0.5 + p[2] / 4), 1};
    };
    const SimplifiedAsset baked = bake_onto(painted(icosphere(5), color), plain(globe(12, 1)), lossless());
    const auto expected = [&](std::size_t, const Vec3& p) {
        const double r = std::hypot(p[0], p[1], p[2]);
        const Vec4f linear = color({p[0] / r, p[1] / r, p[2] / r});
        Color srgb;
        for (std::size_t k = 0; k < 3; ++k) srgb[k] = 255 * detail::srgb_from_linear(linear[k]);
        return srgb;
    };
    CHECK(worst(baked.asset, expected) < 4);
    // The middles of the faces of the globe are below the sphere.
    CHECK(baked.report.coverage->largest_distance > 0.005);
    CHECK(baked.report.coverage->largest_distance < 0.04);
    CHECK(baked.report.coverage->missing_texels == 0);
}

TEST_CASE("neither side of a thin wall shows the colour of the other one") {
    const auto color = [](const Vec3& p) { return p[2] > 0.5 ? red : blue; };
    Asset source = painted(plate(0.499, 0.501), color);
    // Above, inside of, and below the wall.
    const auto [bottom, top] =
        GENERATE(std::pair(0.48, 0.52), std::pair(0.4998, 0.5002), std::pair(0.47, 0.48));
    const SimplifiedAsset baked = bake_onto(source, plain(plate(bottom, top)), lossless());
    const double middle = (bottom + top) / 2;
    CHECK(worst(baked.asset, [&](std::size_t, const Vec3& p) {
              return p[2] > middle ? Color{255, 0, 0} : Color{0, 0, 255};
          }) < 1e-6);
}

TEST_CASE("nested shells each show their own one") {
    const TriangleMesh outer = icosphere(3), inner = scaled(outer, 0.97);
    const Asset source = together(painted(outer, red), painted(inner, blue));
    const auto baked = bake_onto(source, together(plain(outer), plain(inner)), lossless());
    CHECK(worst(baked.asset, [](std::size_t part, const Vec3&) {
              return part == 0 ? Color{255, 0, 0} : Color{0, 0, 255};
          }) < 1e-6);
}

TEST_CASE("a part shows that of its name, although another one is nearer") {
    const auto sphere = [](double radius, const char* name, const Vec4f& color) {
        Asset result = painted(scaled(icosphere(3), radius), color);
        result.parts[0].name = name;
        return result;
    };
    const Asset source = together(sphere(1, "bolt", red), sphere(1.02, "nut", blue));
    const bool named = GENERATE(true, false);
    const Asset target =
        together(sphere(1.005, named ? "nut" : "", red), sphere(1.015, named ? "bolt" : "", red));
    const SimplifiedAsset baked = bake_onto(source, target, lossless());
    CHECK(worst(baked.asset, [&](std::size_t part, const Vec3&) {
              return (part == 0) == named ? Color{0, 0, 255} : Color{255, 0, 0};
          }) < 1e-6);
}

TEST_CASE("parts without names show those whose boxes are like theirs, and a whole all of them") {
    const TriangleMesh left = icosphere(4), right = moved(left, {1.2, 0, 0});
    const Asset source = together(painted(left, red), painted(right, blue));
    const Asset target = together(plain(scaled(left, 1.01)), plain(right));
    const SimplifiedAsset each = bake_onto(source, target, lossless());
    CHECK(worst(each.asset, [](std::size_t part, const Vec3&) {
              return part == 0 ? Color{255, 0, 0} : Color{0, 0, 255};
          }) < 1e-6);
    const SimplifiedAsset whole = bake_onto(source, plain(both(left, right)), lossless());
    for_each_color(whole.asset, [](std::size_t, const Vec3& p, const Color& got) {
        if (p[0] < 0) CHECK(got[0] > 254);
        if (p[0] > 1.2) CHECK(got[2] > 254);
    });
}

TEST_CASE("texels above a hole of the source are counted, and have the colours around it") {
    TriangleMesh holed = moved(grid(16), {});
    std::erase_if(holed.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](Index v) {
            const Vec3& p = holed.positions[v];
            return p[0] >= 4 && p[0] <= 12 && p[1] >= 4 && p[1] <= 12;
        });
    });
    const OntoOptions near{.max_distance = model_units(0.5)};
    Options options = lossless();
    options.bake.texel_density = 8;
    const SimplifiedAsset baked = bake_onto(painted(holed, red), plain(scaled(grid(1), 16)), options, near);
    // A square of side 8, except for what is nearer than 0.5 to its border, of one of side 16.
    CHECK(baked.report.coverage->missing_texels == Approx(49.0 / 256).margin(0.01));
    CHECK(baked.report.coverage->largest_distance == Approx(0.5).margin(0.1));
    CHECK(testing::any_contains(baked.report.warnings, "19% of the texels have no point of the source"));
    CHECK(worst(baked.asset, [](std::size_t, const Vec3&) { return Color{255, 0, 0}; }) < 1e-6);
}

TEST_CASE("parts without a counterpart are reported, and a target with no other ones is refused") {
    const Asset source = textured_square(ramp(64)), far = plain(moved(grid(1), {0, 0, 9}));
    const SimplifiedAsset baked = bake_onto(source, together(source, far), lossless());
    CHECK(baked.report.coverage->unmatched_parts == std::vector<std::string>{"part 1"});
    CHECK(testing::any_contains(baked.report.warnings, "part 1: no point of the source is near it"));
    CHECK(testing::message_of([&] { bake_onto(source, far); }) ==
          "target: no point of it is near the source, on the side that the source shows: they must be at the "
          "same place "
          "and of the same size, or max_distance must be larger");
}

TEST_CASE("the target keeps what is not appearance") {
    const Asset source = textured_square(ramp(64));
    Asset target = textured_square(ramp(4));
    Part& part = target.parts[0];
    part.normals.assign(4, {0, 0, 1});
    part.joints.assign(4, {1, 0, 0, 0});
    part.weights.assign(4, {1, 0, 0, 0});
    part.colors.assign(4, {0, 1, 0, 1});
    part.morph_targets.resize(1);
    for (float v = 0; v < 4; ++v) part.morph_targets[0].positions.push_back({v, 0, 0});
    const SimplifiedAsset baked = bake_onto(source, target, lossless());
    const Part& to = baked.asset.parts[0];
    CHECK(to.joints == part.joints);
    CHECK(to.normals == part.normals);
    REQUIRE(to.positions.size() == 4);
    for (std::size_t v = 0; v < 4; ++v) {
        const auto same = std::ranges::find(part.positions, to.positions[v]) - part.positions.begin();
        CHECK(to.morph_targets[0].positions[v][0] == static_cast<float>(same));
    }
    CHECK(to.colors.empty());
    CHECK(baked.asset.images.size() == 1);
    CHECK(baked.asset.materials.size() == 1);
    CHECK(testing::any_contains(baked.report.warnings, "its vertex colours were left out"));
}

TEST_CASE("a target gets the normals of its source as a normal map") {
    Asset source;
    source.parts = {sheet(8, [](double x, double y) { return Vec3{x, y, 0.3 * (x - 4)}; })};
    Options options = lossless();
    options.bake.normal_map = NormalMap::on;
    const SimplifiedAsset baked = bake_onto(source, plain(scaled(grid(1), 8)), options);
    const Part& part = baked.asset.parts[0];
    REQUIRE(part.normals.size() == part.positions.size());
    const Pixels pixels = decode(baked.asset.images.at(baked.asset.materials[0].normal_texture.image));
    for (const Vec3& w : spread(4)) {
        const auto c = look(part, pixels, 0, w);
        const double along = c[0] / 127.5 - 1, up = c[2] / 127.5 - 1;
        const Vec4f& t = part.tangents[part.triangles[0][0]];
        // In the plane of the target: the tangent, and the bitangent at right angles to it.
        const double across = t[3] * (c[1] / 127.5 - 1);
        CHECK((t[0] * along - t[1] * across) / up == Approx(-0.3).margin(0.02));
        CHECK((t[1] * along + t[0] * across) / up == Approx(0).margin(0.02));
    }
}

TEST_CASE("a target keeps UVs on which every texel has one place") {
    const Asset source = textured_square(ramp(256));
    Asset target = textured_square(ramp(4));
    Part& part = target.parts[0];
    // Two islands: the second one is mirrored, and apart from the first.
    part.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    part.triangles = {{0, 1, 2}, {3, 4, 5}};
    part.uvs = {{{0, 0.4f}, {0.4f, 0.4f}, {0.4f, 0}, {0.9f, 0.9f}, {0.5f, 0.5f}, {0.9f, 0.5f}}};
    Options options = lossless();
    options.bake.texel_density = 2;
    const SimplifiedAsset baked = bake_onto(source, target, options, {.uvs = OntoUvs::keep});
    CHECK(baked.asset.parts[0].uvs == part.uvs);
    CHECK(baked.asset.parts[0].triangles == part.triangles);
    CHECK(worst(baked.asset, [](std::size_t, const Vec3& p) { return ramp_at(p); }) <= 1);
    CHECK(bake_onto(source, target, options).asset.parts[0].uvs == part.uvs);

    part.uvs[0][3] = {0.3f, 0.1f};  // the second island covers a part of the first one
    CHECK(testing::message_of([&] { bake_onto(source, target, options, {.uvs = OntoUvs::keep}); }) ==
          "target: its UVs cannot be kept, because some overlap: new ones are needed");
    const SimplifiedAsset other = bake_onto(source, target, options);
    CHECK(other.asset.parts[0].uvs != part.uvs);
    CHECK(worst(other.asset, [](std::size_t, const Vec3& p) { return ramp_at(p); }) <= 1);
}

TEST_CASE("an atlas onto another mesh does not depend on the number of threads") {
    const Asset source = painted(icosphere(4), [](const Vec3& p) {
        return Vec4f{float(0.5 + p[0] / 2), float(0.5 + p[1] / 2), 0.5f, 1};
    });
    Options options = lossless();
    options.threads = 1;
    const SimplifiedAsset one = bake_onto(source, plain(globe(9, 1.01)), options);
    options.threads = 4;
    const SimplifiedAsset four = bake_onto(source, plain(globe(9, 1.01)), options);
    CHECK(one.asset.images[0].encoded == four.asset.images[0].encoded);
    CHECK(one.asset.parts[0].uvs == four.asset.parts[0].uvs);
    CHECK(one.report.coverage->largest_distance == four.report.coverage->largest_distance);
}

TEST_CASE("the result has the format of the target if that has textures, otherwise it is a GLB") {
    const Asset source = textured_square(ramp(64));
    Asset target = plain(grid(1));
    target.format = ModelFormat::obj;
    CHECK(bake_onto(source, target).asset.format == ModelFormat::obj);
    target.format = ModelFormat::stl;
    CHECK(bake_onto(source, target).asset.format == ModelFormat::glb);
    Options options;
    options.format = ModelFormat::ply;
    CHECK_THROWS_AS(bake_onto(source, target, options), OptionError);
}
