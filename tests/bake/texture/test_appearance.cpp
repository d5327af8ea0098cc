// Normals of the simplified mesh, image formats, and reports of pages.
#include <cstring>
#include <sstream>

#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

const Vec3f up = {0, 0, 1};

// Two squares with an angle of 60 degrees between their face normals, and with wrong vertex normals.
Asset roof() {
    Asset asset;
    asset.parts.resize(1);
    Part& part = asset.parts[0];
    const double h = std::sqrt(3.0) / 2;
    part.positions = {{0, 0, 0}, {0, 1, 0}, {-h, 0, -0.5}, {-h, 1, -0.5}, {h, 0, -0.5}, {h, 1, -0.5}};
    part.triangles = {{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1}};
    part.normals.assign(6, {0.6f, 0, 0.8f});
    return asset;
}

Part normals_of(Normals kind, double angle) {
    const Asset asset = roof();
    Options options = lossless();
    options.bake.kind = Bake::none;
    options.bake.normals = kind;
    options.bake.crease_angle = angle;
    return bake(asset, unchanged(asset), options).asset.parts[0];
}

Options encoded_as(ImageFormat format) {
    Options options = lossless();
    options.bake.image_format = format;
    return options;
}

const Image& base_image(const SimplifiedAsset& simplified) {
    return simplified.asset.images[simplified.asset.materials[0].base_color_texture.image];
}

}  // namespace

TEST_CASE("smooth normals are averages of simplified face normals up to the crease angle") {
    const Part sharp = normals_of(Normals::smooth, 50), smooth = normals_of(Normals::smooth, 70);
    CHECK(sharp.positions.size() == 8);
    REQUIRE(smooth.positions.size() == 6);
    for (std::size_t v = 0; v < 6; ++v) {
        if (smooth.positions[v][0] != 0) continue;
        for (std::size_t k = 0; k < 3; ++k) CHECK(smooth.normals[v][k] == Approx(up[k]).margin(1e-6));
    }
}

TEST_CASE("flat normals are the face normals at any crease angle") {
    const Part part = normals_of(Normals::flat, 180);
    CHECK(part.positions.size() == 8);
    for (const Vec3f& n : part.normals) {
        CHECK(std::abs(n[0]) == Approx(0.5));
        CHECK(n[2] == Approx(std::sqrt(3.0) / 2));
    }
}

TEST_CASE("normals can be omitted without baking and then no vertex is split") {
    const Part part = normals_of(Normals::none, 40);
    CHECK(part.normals.empty());
    CHECK(part.positions.size() == 6);
}

TEST_CASE("normals can be omitted with every kind that makes no atlas, also if it is automatic") {
    for (const Bake kind : {Bake::automatic, Bake::vertex, Bake::keep, Bake::none}) {
        Options options = lossless();
        options.bake.normals = Normals::none;
        options.bake.kind = kind;
        const SimplifiedAsset flat = bake(roof(), unchanged(roof()), options);
        CHECK(flat.asset.parts[0].normals.empty());
        CHECK(flat.asset.parts[0].positions.size() == 6);
        CHECK(flat.report.vertices_split == 0);
    }
    for (const Bake kind : {Bake::atlas, Bake::per_triangle}) {
        Options options = lossless();
        options.bake.normals = Normals::none;
        options.bake.kind = kind;
        CHECK_THROWS_AS(bake(roof(), unchanged(roof()), options), OptionError);
    }
}

TEST_CASE("a new texture without normals has no normal map, and is no error") {
    Asset asset = textured_square(ramp(16));
    asset.materials[0].normal_texture = asset.materials[0].base_color_texture;
    Options options = lossless();
    options.bake.normals = Normals::none;
    options.bake.untouched = UntouchedParts::baked;
    const SimplifiedAsset baked = bake(asset, unchanged(asset), options);
    REQUIRE(baked.report.pages.size() == 1);
    CHECK(baked.asset.parts[0].normals.empty());
    CHECK(!baked.asset.materials[0].normal_texture);
    options.bake.normal_map = NormalMap::on;
    CHECK_THROWS_AS(bake(asset, unchanged(asset), options), OptionError);
}

TEST_CASE("automatic normals are in PLY and OBJ only if the source has some or there is a normal map") {
    Asset bare = roof();
    bare.parts[0].normals.clear();
    for (const ModelFormat format : {ModelFormat::ply, ModelFormat::obj, ModelFormat::glb}) {
        Options options = lossless();
        options.format = format;
        options.bake.untouched = UntouchedParts::baked;
        CHECK(bake(bare, unchanged(bare), options).asset.parts[0].normals.empty() ==
              (format != ModelFormat::glb));
        CHECK(!bake(roof(), unchanged(roof()), options).asset.parts[0].normals.empty());
    }
    Asset textured = textured_square(ramp(16));
    textured.parts[0].normals.clear();
    Options options = lossless();
    options.format = ModelFormat::obj;
    options.bake.kind = Bake::atlas;
    CHECK(bake(textured, unchanged(textured), options).asset.parts[0].normals.empty());
    textured.materials[0].normal_texture = textured.materials[0].base_color_texture;
    CHECK(!bake(textured, unchanged(textured), options).asset.parts[0].normals.empty());
}

TEST_CASE("normals that follow from one smoothing group are no normals of the source in OBJ and PLY") {
    Asset asset = roof();
    asset.smoothing = Smoothing::on;
    for (const ModelFormat format : {ModelFormat::ply, ModelFormat::obj, ModelFormat::glb}) {
        for (const UntouchedParts untouched : {UntouchedParts::automatic, UntouchedParts::baked}) {
            Options options = lossless();
            options.format = format;
            options.bake.untouched = untouched;
            const Asset result = bake(asset, unchanged(asset), options).asset;
            CHECK(result.parts[0].normals.empty() == (format != ModelFormat::glb));
            CHECK((result.smoothing == Smoothing::on) == (format != ModelFormat::glb));
        }
    }
}

TEST_CASE("automatic normals split a vertex in PLY where the source has two normals and only there") {
    // The ridge is sharp, but both sides share its normals; then they have normals of their own.
    const auto vertices = [](const Asset& asset, std::uint64_t& split) {
        Options options = lossless();
        options.format = ModelFormat::ply;
        options.bake.untouched = UntouchedParts::baked;
        const SimplifiedAsset baked = bake(asset, unchanged_welded(asset), options);
        split = baked.report.vertices_split;
        return baked.asset.parts[0].positions.size();
    };
    Asset asset = roof();
    const float h = std::sqrt(0.75f);
    asset.parts[0].normals = {up, up, {-h, 0, 0.5f}, {-h, 0, 0.5f}, {h, 0, 0.5f}, {h, 0, 0.5f}};
    std::uint64_t split = 1;
    CHECK(vertices(asset, split) == 6);
    CHECK(split == 0);
    Part& part = asset.parts[0];
    part.positions.insert(part.positions.end(), {{0, 0, 0}, {0, 1, 0}});
    part.triangles = {{0, 1, 3}, {0, 3, 2}, {6, 4, 5}, {6, 5, 7}};
    part.normals = {{-h, 0, 0.5f}, {-h, 0, 0.5f}, {-h, 0, 0.5f}, {-h, 0, 0.5f},
                    {h, 0, 0.5f},  {h, 0, 0.5f},  {h, 0, 0.5f},  {h, 0, 0.5f}};
    CHECK(vertices(asset, split) == 8);
    CHECK(split == 2);
}

TEST_CASE("baked images are PNG or JPEG or have the format of the source") {
    Asset asset = textured_square(ramp(64));
    CHECK(base_image(bake(asset, unchanged(asset), lossless())).mime_type == "image/png");
    const SimplifiedAsset jpeg = bake(asset, unchanged(asset), encoded_as(ImageFormat::jpeg));
    CHECK(base_image(jpeg).mime_type == "image/jpeg");
    const auto c = look(jpeg.asset.parts[0], decode(base_image(jpeg)), 0, {0.3, 0.3, 0.4});
    const auto painted = look(asset.parts[0], ramp(64), 0, {0.3, 0.3, 0.4});
    for (std::size_t k = 0; k < 3; ++k) CHECK(c[k] == Approx(painted[k]).margin(6));
    CHECK(base_image(bake(asset, unchanged(asset), encoded_as(ImageFormat::source))).mime_type ==
          "image/png");
    asset.images[0] = encode_jpeg(ramp(64), "photo", 95, Content::color);
    CHECK(base_image(bake(asset, unchanged(asset), encoded_as(ImageFormat::source))).mime_type ==
          "image/jpeg");
}

TEST_CASE("images with alpha are always PNG") {
    Asset asset = textured_square(ramp(16));
    asset.materials[0].alpha_mode = AlphaMode::blend;
    CHECK(base_image(bake(asset, unchanged(asset), encoded_as(ImageFormat::jpeg))).mime_type == "image/png");
}

TEST_CASE("a lower JPEG quality gives smaller images") {
    const Asset asset = textured_square(paint(64, 64, [](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(x * 37 + y * 91), static_cast<std::uint8_t>(x * y), 9, 255};
    }));
    Options low = encoded_as(ImageFormat::jpeg), high = low;
    low.bake.jpeg_quality = 20;
    high.bake.jpeg_quality = 95;
    CHECK(base_image(bake(asset, unchanged(asset), low)).encoded.size() * 2 <
          base_image(bake(asset, unchanged(asset), high)).encoded.size());
}

TEST_CASE("texel_density is relative to the texel density of the source") {
    const Asset asset = textured_square(ramp(128));
    for (const double factor : {0.25, 0.5, 1.0, 2.0}) {
        Options options = lossless();
        options.bake.texel_density = factor;
        const BakedPage page = bake(asset, unchanged(asset), options).report.pages[0];
        CHECK(page.density > 0.9 * factor);
        CHECK(page.density < 1.6 * factor);
    }
}

TEST_CASE("a page much coarser than the source causes a warning unless texel_density requests it") {
    // The texture is repeated 10 x 10 times.
    Asset asset = textured_square(ramp(128));
    asset.materials[0].base_color_texture.wrap_u = asset.materials[0].base_color_texture.wrap_v =
        Wrap::repeat;
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv = {10 * uv[0], 10 * uv[1]};
    Options options = lossless();
    options.bake.texture_size = 128;
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    REQUIRE(simplified.report.warnings.size() == 1);
    CHECK(simplified.report.warnings[0] ==
          "atlas of material 'paint': one texel for 11 x 11 texels of the source; texture_size is 128");
    options.bake.texel_density = 0.125;
    CHECK(bake(asset, unchanged(asset), options).report.warnings.empty());
    options.bake.texture_size = 2048;
    options.bake.texel_density.reset();
    CHECK(bake(asset, unchanged(asset), options).report.warnings.empty());
}

TEST_CASE("the warning of a coarse page names the material that loses most") {
    // The texels of the label are 17 times smaller than those around it, which fill the page.
    Asset asset = textured_square(ramp(128));
    asset.images.push_back(encode_png(ramp(64), "label"));
    Material label = asset.materials[0];
    label.name = "label";
    label.base_color_texture.image = 1;
    asset.materials.push_back(label);
    Part& part = asset.parts[0];
    part.face_material = {0, 0, 1};
    part.triangles.push_back({4, 5, 6});
    for (const Vec2f& uv : {Vec2f{0, 0}, Vec2f{1, 0}, Vec2f{0, 1}}) {
        part.positions.push_back({2 + 0.03 * uv[0], 0.03 * uv[1], 0});
        part.uvs[0].push_back(uv);
    }
    if (!part.normals.empty()) part.normals.resize(part.positions.size(), part.normals[0]);
    Options options = lossless();
    options.bake.texture_size = 128;
    const std::vector<std::string> warnings = bake(asset, unchanged(asset), options).report.warnings;
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], ContainsSubstring(" texels of the source in material 'label'"));
    options.bake.texture_size = 2048;
    CHECK(bake(asset, unchanged(asset), options).report.warnings.empty());
}

TEST_CASE("without texel_density only small pages are finer than the source") {
    const auto density = [](std::uint32_t side, std::optional<double> requested) {
        const Asset asset = textured_square(ramp(side));
        Options options = lossless();
        options.bake.texel_density = requested;
        return bake(asset, unchanged(asset), options).report.pages[0].density;
    };
    CHECK(density(256, {}) > 1.3 * density(256, 1.0));
    CHECK(density(700, {}) == density(700, 1.0));
}

TEST_CASE("the report gives fill, texel density and sample counts of a page") {
    const Asset asset = textured_square(ramp(128));
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    REQUIRE(simplified.report.pages.size() == 1);
    const BakedPage& page = simplified.report.pages[0];
    CHECK(page.material == "paint");
    CHECK(page.width == decode(base_image(simplified)).width);
    CHECK(page.fill > 0.5);
    CHECK(page.fill <= 1);
    CHECK(page.density > 1.3);
    CHECK(page.density < 2);
    CHECK(double(page.samples[0]) == Approx(4 * page.fill * page.width * page.height));
    CHECK(page.samples[1] + page.samples[2] == 0);
    CHECK(page.uncertain_texels == 0);
}

TEST_CASE("the correspondence gives the source point of every texel") {
    const Asset asset = textured_square(ramp(64));
    Options options = lossless();
    options.bake.correspondence = Recording::on;
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    REQUIRE(simplified.correspondence.size() == 1);
    const PageOrigins& page = simplified.correspondence[0];
    const Pixels atlas = decode(base_image(simplified));
    REQUIRE(page.texels.size() == std::size_t{atlas.width} * atlas.height);
    CHECK(page.material == 0);
    std::size_t shown = 0;
    for (std::size_t i = 0; i < page.texels.size(); ++i) {
        const TexelOrigin& texel = page.texels[i];
        if (texel.part == no_index) continue;
        ++shown;
        const auto there = look(asset.parts[0], ramp(64), texel.point.face, texel.point.barycentric);
        CHECK(atlas.rgba[4 * i] == Approx(there[0]).margin(4));
    }
    CHECK(double(shown) == Approx(simplified.report.pages[0].fill * double(page.texels.size())));

    std::ostringstream out;
    write(simplified.correspondence, out);
    const std::string bytes = out.str();
    REQUIRE(bytes.size() == 8 + 4 + 12 + 20 * page.texels.size());
    CHECK(bytes.substr(0, 8) == "FAQEMC01");
    std::uint32_t width = 0;
    std::memcpy(&width, &bytes[16], 4);
    CHECK(width == page.width);
    CHECK(bake(asset, unchanged(asset), lossless()).correspondence.empty());
    options.bake.kind = Bake::vertex;
    CHECK_THROWS_AS(bake(asset, unchanged(asset), options), OptionError);
}
