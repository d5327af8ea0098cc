#include <cmath>

#include "support/scenes.hpp"

#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// A sphere with a smooth ramp as texture, projected along z: u and v are linear in x and y.
Asset painted_ball() {
    Asset asset = textured_square(ramp(64));
    const auto uv_of = [](const Vec3& p) { return std::array{0.5 + 0.45 * p[0], 0.5 + 0.45 * p[1]}; };
    asset.parts = {uv_mapped(part_of(icosphere(3)), uv_of)};
    return asset;
}

Options of_kind(Bake kind, std::uint32_t size) {
    Options options = lossless();
    options.bake.kind = kind;
    options.bake.texture_size = size;
    return options;
}

// The next mip level.
Pixels half(const Pixels& pixels) {
    return paint(pixels.width / 2, pixels.height / 2, [&](std::uint32_t x, std::uint32_t y) {
        Rgba result;
        for (std::size_t k = 0; k < 4; ++k) {
            unsigned sum = 2;
            for (std::uint32_t i = 0; i < 4; ++i)
                sum += pixels.rgba[4 * (std::size_t{2 * y + i / 2} * pixels.width + 2 * x + i % 2) + k];
            result[k] = static_cast<std::uint8_t>(sum / 4);
        }
        return result;
    });
}

// The largest difference of a channel over all faces, including their corners and edges.
double worst_color(const Asset& source, const Pixels& before, const Asset& simplified, const Pixels& after) {
    double worst = 0;
    const Part &a = source.parts[0], &b = simplified.parts[0];
    for (std::size_t f = 0; f < a.triangles.size(); ++f) {
        for (const Vec3& w : spread(4)) {
            const auto x = look(a, before, f, w), y = look(b, after, f, w);
            for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(x[k] - y[k]));
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("charts have the colours of the source at seams and on coarser mip levels") {
    const Asset source = painted_ball();
    const SimplifiedAsset simplified = bake(source, unchanged(source), of_kind(Bake::atlas, 256));
    REQUIRE(simplified.asset.images.size() == 1);
    Pixels after = decode(simplified.asset.images[0]);
    const Pixels before = decode(source.images[0]);
    CHECK(worst_color(source, before, simplified.asset, after) < 4);
    for (int level = 1; level < 3; ++level) {
        after = half(after);
        CHECK(worst_color(source, before, simplified.asset, after) < 4 + 4 * level);
    }
}

TEST_CASE("no unrelated texels are read at seams at any texel density") {
    const Asset source = painted_ball();
    const Pixels before = decode(source.images[0]);
    const double density = GENERATE(0.82, 1.0, 1.11, 1.416, 1.46, 2.01, 2.13, 3.96);
    Options options = of_kind(Bake::atlas, 512);
    options.bake.texel_density = density;
    const SimplifiedAsset simplified = bake(source, unchanged(source), options);
    // The ramp increases by 180 over 64 source texels: 2.9 per texel.
    const double texels = worst_color(source, before, simplified.asset, decode(simplified.asset.images[0])) /
                          (180.0 / 63) * simplified.report.pages[0].density;
    CHECK(texels < 1.6);
}

// Compared with the nearest source texel at each sample of the texels within a triangle of the page.
TEST_CASE("a texel whose first two samples differ is the mean of all four in linear light") {
    constexpr std::uint32_t size = 48;
    const auto is_white = [](double u, double v) { return std::floor(u * size) > std::floor(v * size); };
    Asset source = textured_square(paint(size, size, [&](std::uint32_t x, std::uint32_t y) -> Rgba {
        return is_white((x + 0.5) / size, (y + 0.5) / size) ? Rgba{255, 255, 255, 255} : Rgba{0, 0, 0, 255};
    }));
    source.materials[0].base_color_texture.filter = Filter::nearest;
    Options options = of_kind(Bake::atlas, 128);
    options.bake.texel_density = 1.6;
    const SimplifiedAsset baked = bake(source, unchanged(source), options);
    const Pixels page = decode(baked.asset.images.at(0));
    const Part &before = source.parts[0], &after = baked.asset.parts[0];
    const std::array<int, 5> means = {0, 137, 188, 225, 255};  // of 0 to 4 white samples
    std::array<int, 5> texels = {};
    for (std::size_t f = 0; f < after.triangles.size(); ++f) {
        const auto corner = [&](const Part& part, std::size_t i) {
            return part.uvs[0][part.triangles[f][i]];
        };
        const auto at = [&](std::size_t i, std::size_t k) {
            return double{corner(after, i)[k]} * (k == 0 ? page.width : page.height);
        };
        const double x1 = at(1, 0) - at(0, 0), y1 = at(1, 1) - at(0, 1), x2 = at(2, 0) - at(0, 0),
                     y2 = at(2, 1) - at(0, 1);
        const auto weights = [&](double x, double y) {
            const double dx = x - at(0, 0), dy = y - at(0, 1), area = x1 * y2 - x2 * y1;
            const double v = (dx * y2 - x2 * dy) / area, w = (x1 * dy - dx * y1) / area;
            return Vec3{1 - v - w, v, w};
        };
        for (std::uint32_t i = 0; i < page.width * page.height; ++i) {
            const std::uint32_t x = i % page.width, y = i / page.width;
            std::size_t white = 0, on_diagonal = 0;  // white samples
            bool is_inside = true;
            for (const double s : {0.25, 0.75}) {
                for (const double t : {0.25, 0.75}) {
                    const Vec3 w = weights(x + s, y + t);
                    is_inside = is_inside && w[0] > 0.01 && w[1] > 0.01 && w[2] > 0.01;
                    std::array<double, 2> uv = {};
                    for (std::size_t c = 0; c < 3; ++c)
                        for (std::size_t k = 0; k < 2; ++k) uv[k] += w[c] * double{corner(before, c)[k]};
                    white += is_white(uv[0], uv[1]);
                    // Of the samples on the diagonal that is taken first.
                    if ((s == t) == ((x + y) % 2 == 0)) on_diagonal += is_white(uv[0], uv[1]);
                }
            }
            if (!is_inside) continue;
            ++texels[white];
            CHECK(int{page.rgba[4 * std::size_t{i}]} == means[on_diagonal == 1 ? white : 2 * on_diagonal]);
        }
    }
    for (const int count : texels) CHECK(count > 5);
}

TEST_CASE("charts split few vertices and the report describes the page") {
    const Asset source = painted_ball();
    const SimplifiedParts simplified = unchanged(source);
    const SimplifiedAsset charts = bake(source, simplified, of_kind(Bake::atlas, 256));
    const SimplifiedAsset triangles = bake(source, simplified, of_kind(Bake::per_triangle, 256));
    CHECK(charts.asset.parts[0].positions.size() < 1.5 * double(source.parts[0].positions.size()));
    CHECK(triangles.asset.parts[0].positions.size() > 2 * source.parts[0].positions.size());
    REQUIRE(charts.report.pages.size() == 1);
    const BakedPage& page = charts.report.pages[0];
    CHECK(page.material == "paint");
    CHECK(page.kind == Bake::atlas);
    CHECK(page.faces == source.parts[0].triangles.size());
    CHECK((page.charts > 1 && page.charts < 20));
    CHECK(page.faces_outside_charts == 0);
    CHECK((page.fill > 0.3 && page.fill < 1));
    CHECK((page.stretch >= 1 && page.stretch < 1.06));
    CHECK(triangles.report.pages.at(0).kind == Bake::per_triangle);
    CHECK(charts.report.warnings.empty());
}

// A slab 1.5 texels thick, with a different colour on every side.
TEST_CASE("colours do not bleed across creases into a strip one texel wide") {
    const std::array<Rgba, 6> colors = {{{220, 0, 0, 255},
                                         {0, 0, 220, 255},
                                         {120, 120, 120, 255},
                                         {0, 200, 0, 255},
                                         {200, 200, 0, 255},
                                         {0, 200, 200, 255}}};
    Asset source =
        textured_square(paint(384, 64, [&](std::uint32_t x, std::uint32_t) { return colors[x / 64]; }));
    Part& part = source.parts[0];
    part = {};
    part.uvs.resize(1);
    const double thick = 1.5 / 48;
    const std::array<std::array<int, 4>, 6> sides = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (std::size_t s = 0; s < 6; ++s) {
        const auto first = static_cast<Index>(part.positions.size());
        for (const int i : sides[s]) {
            part.positions.push_back({double(i & 1), double(i >> 1 & 1), thick * (i >> 2)});
            // Equal density everywhere: 48 texels per unit of length, at a distance from the other colours.
            const double along = s < 2 ? double(i >> 1 & 1) : thick * (i >> 2);
            const double across = s < 4 ? double(i & 1) : double(i >> 1 & 1);
            part.uvs[0].push_back({static_cast<float>((64 * double(s) + 8 + 48 * along) / 384),
                                   static_cast<float>(0.125 + 0.75 * across)});
        }
        part.triangles.push_back({first, first + 1, first + 2});
        part.triangles.push_back({first, first + 2, first + 3});
    }
    part.face_material.assign(12, 0);
    const auto kind = GENERATE(Bake::atlas, Bake::per_triangle);
    const SimplifiedAsset simplified = bake(source, unchanged_welded(source), of_kind(kind, 128));
    CHECK(worst_color(source, decode(source.images[0]), simplified.asset,
                      decode(simplified.asset.images.at(0))) < 4);
}

TEST_CASE("automatic uses charts unless they have too few faces") {
    Asset source = painted_ball();
    CHECK(bake(source, unchanged(source), of_kind(Bake::automatic, 256)).report.pages.at(0).kind ==
          Bake::atlas);
    Part& part = source.parts[0];
    Part apart = part;
    apart.positions.clear();
    apart.uvs[0].clear();
    for (Triangle& t : apart.triangles) {
        for (Index& v : t) {
            apart.positions.push_back(part.positions[v]);
            apart.uvs[0].push_back(part.uvs[0][v]);
            v = static_cast<Index>(apart.positions.size() - 1);
        }
    }
    part = apart;
    CHECK(bake(source, unchanged(source), of_kind(Bake::automatic, 256)).report.pages.at(0).kind ==
          Bake::per_triangle);
}

TEST_CASE("every covered texel is mapped to a close point of the source") {
    const Asset source = painted_ball();
    Options options = of_kind(GENERATE(Bake::atlas, Bake::per_triangle), GENERATE(64u, 256u));
    options.target = ratio(GENERATE(1.0, 0.1, 0.02));
    options.bake.correspondence = Recording::on;
    const SimplifiedAsset simplified = simplify(source, options);
    REQUIRE(simplified.correspondence.size() == 1);
    const PageOrigins& page = simplified.correspondence[0];
    const Part &from = source.parts[0], &part = simplified.asset.parts[0];
    std::size_t covered = 0, unmapped = 0;
    double farthest = 0;
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        for (const Vec3& w : spread(24)) {
            const auto uv = blend(part.uvs[0], part.triangles[f], w);
            const auto x = static_cast<std::size_t>(uv[0] * page.width);
            const auto y = static_cast<std::size_t>(uv[1] * page.height);
            const TexelOrigin& texel = page.texels.at(y * page.width + x);
            ++covered;
            if (texel.part != 0 || !(texel.point.face < from.triangles.size())) {
                ++unmapped;
                continue;
            }
            const Vec3 here = blend(part.positions, part.triangles[f], w);
            const Vec3 there =
                blend(from.positions, from.triangles[texel.point.face], texel.point.barycentric);
            farthest =
                std::max(farthest, std::hypot(here[0] - there[0], here[1] - there[1], here[2] - there[2]));
        }
    }
    CHECK(covered > 0);
    CHECK(unmapped == 0);
    CHECK(farthest < 0.4);  // the diameter is 2: some texels and most simplified faces have this size
}

// Two squares with a ramp each; one is invisible by its factor, or by its texture.
TEST_CASE("a material without visible texels keeps its colours under alpha 0") {
    const bool by_factor = GENERATE(true, false);
    const Bake kind = GENERATE(Bake::atlas, Bake::per_triangle);
    const Pixels visible = ramp(64);
    Asset source = textured_square(visible);
    Pixels hidden = ramp(64);
    for (std::size_t i = 0; i < hidden.rgba.size(); i += 4) {
        hidden.rgba[i + 2] = 200;
        if (!by_factor) hidden.rgba[i + 3] = 0;
    }
    hidden.has_alpha = !by_factor;
    source.materials.push_back(source.materials[0]);
    source.materials[1].base_color_texture.image = add_texture(source, hidden);
    if (by_factor) source.materials[1].base_color[3] = 0;
    for (Material& m : source.materials) m.alpha_mode = AlphaMode::blend;
    source.parts.push_back(square());
    source.parts[1].face_material = {1, 1};
    const SimplifiedAsset simplified = bake(source, unchanged(source), of_kind(kind, 256));
    REQUIRE(simplified.asset.images.size() == 1);
    const Pixels after = decode(simplified.asset.images[0]);
    const std::array<const Pixels*, 2> before = {&visible, &hidden};
    for (std::size_t p = 0; p < 2; ++p) {
        const Part& part = simplified.asset.parts[p];
        for (std::size_t f = 0; f < 2; ++f) {
            for (const Vec3& w : spread(4)) {
                const auto expected = look(source.parts[p], *before[p], f, w),
                           found = look(part, after, f, w);
                for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(found[k] - expected[k]) < 5);
                CHECK(found[3] == Approx(p == 0 ? 255 : 0).margin(1));
            }
        }
    }
}
