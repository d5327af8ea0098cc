#include "render/rasterizer.hpp"

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace faqem::render;
using Eigen::Vector4f;

namespace {

constexpr std::uint32_t size = 64;

/// Renders the asset from +z, or rotated about y by `azimuth`, so that it fits into the image.
Frame picture(const faqem::Asset& asset, Shading shading = Shading::unlit, double azimuth = 0,
              Edges edges = Edges::hidden, Backs backs = Backs::drawn) {
    const Scene scene = make_scene(asset);
    Camera camera = orbit_camera(azimuth, 0);
    show_all(placed_meshes(scene), {&camera, 1});
    camera.eye *= 1.06;
    return render(scene, camera, size, shading, edges, backs);
}

/// Pixel at fractions of the width and height from the upper left.
Vector4f at(const Frame& frame, double x, double y) {
    return frame.pixels[static_cast<std::size_t>(y * frame.size) * frame.size +
                        static_cast<std::size_t>(x * frame.size)];
}

bool near(const Vector4f& a, const Vector4f& b, float tolerance = 0.02f) {
    return (a - b).cwiseAbs().maxCoeff() < tolerance;
}

const Vector4f red(1, 0, 0, 1), blue(0, 0, 1, 1), nothing(0, 0, 0, 0);

/// An untextured square of two faces at the given z.
faqem::Asset square(double z, const faqem::Vec4f& color, faqem::AlphaMode mode = faqem::AlphaMode::opaque) {
    faqem::Asset asset = tool_test::sheet(1, 0);
    for (faqem::Vec3& p : asset.parts[0].positions) p[2] = z;
    asset.images.clear();
    asset.materials[0].base_color_texture = {};
    asset.materials[0].base_color = color;
    asset.materials[0].alpha_mode = mode;
    return asset;
}

faqem::Asset joined(faqem::Asset a, const faqem::Asset& b) {
    faqem::Part part = b.parts[0];
    part.face_material.assign(part.triangles.size(), static_cast<faqem::Index>(a.materials.size()));
    a.parts.push_back(part);
    a.materials.push_back(b.materials[0]);
    return a;
}

}  // namespace

TEST_CASE("a textured square shows its texture upright, and mirrored from behind") {
    const Frame frame = picture(tool_test::sheet(4, 0));
    CHECK(near(at(frame, 0.25, 0.5), red));
    CHECK(near(at(frame, 0.75, 0.5), blue));
    CHECK(near(at(frame, 0.02, 0.02), nothing));
    // From behind, left and right are swapped, and back faces are drawn.
    const Frame behind = picture(tool_test::sheet(4, 0), Shading::unlit, 3.14159265358979);
    CHECK(near(at(behind, 0.25, 0.5), blue));
}

TEST_CASE("hidden backs are those of single-sided faces") {
    const auto middle = [](const faqem::Asset& asset, double azimuth) {
        return at(picture(asset, Shading::unlit, azimuth, Edges::hidden, Backs::hidden), 0.5, 0.5);
    };
    faqem::Asset asset = square(0, {1, 0, 0, 1});
    const double behind = 3.14159265358979;
    CHECK(near(middle(asset, 0), red));
    CHECK(near(middle(asset, behind), nothing));
    asset.materials[0].double_sided = true;
    CHECK(near(middle(asset, behind), red));
}

TEST_CASE("texture coordinate v points down") {
    faqem::Asset asset = tool_test::sheet(1, 0);
    for (faqem::Vec2f& uv : asset.parts[0].uvs[0]) uv = {uv[1], uv[0]};  // transposed
    const Frame frame = picture(asset);
    // u = 1 - height: the left, red half of the image is at the top.
    CHECK(near(at(frame, 0.5, 0.25), red));
    CHECK(near(at(frame, 0.5, 0.75), blue));
}

TEST_CASE("texture coordinates are interpolated with perspective correction") {
    // The right edge of the square is farther away, so its centre is projected closer to that edge.
    faqem::Asset asset = tool_test::sheet(1, 0);
    for (faqem::Vec3& p : asset.parts[0].positions) p = {p[0], p[1], -3 * p[0]};
    const Scene scene = make_scene(asset);
    Camera camera = orbit_camera(0, 0);
    camera.tan_half_fov = 0.5;
    camera.eye = {0, 0, 6};
    const Frame frame = render(scene, camera, size, Shading::unlit, Edges::hidden);
    // The ends are at x = -1 / 3 / 0.5 and 1 / 9 / 0.5 in [-1, 1]; u = 0.5 is at x = 0, not between them.
    CHECK(near(at(frame, 0.47, 0.5), red));
    CHECK(near(at(frame, 0.53, 0.5), blue));
}

TEST_CASE("the nearer face hides the farther one in either draw order") {
    const faqem::Asset front = square(0.5, {1, 0, 0, 1}), back = square(-0.5, {0, 0, 1, 1});
    CHECK(near(at(picture(joined(front, back)), 0.5, 0.5), red));
    CHECK(near(at(picture(joined(back, front)), 0.5, 0.5), red));
}

TEST_CASE("blended faces are composited and masked faces are either opaque or discarded") {
    const faqem::Asset back = square(-0.5, {0, 0, 1, 1});
    const faqem::Asset glass = square(0.5, {1, 0, 0, 0.25f}, faqem::AlphaMode::blend);
    const Vector4f mixed(0.25f, 0, 0.75f, 1);
    CHECK(near(at(picture(joined(glass, back)), 0.5, 0.5), mixed));
    CHECK(near(at(picture(joined(back, glass)), 0.5, 0.5), mixed));
    CHECK(near(at(picture(glass), 0.5, 0.5), Vector4f(0.25f, 0, 0, 0.25f)));
    CHECK(near(at(picture(joined(square(0.5, {1, 0, 0, 0.4f}, faqem::AlphaMode::mask), back)), 0.5, 0.5),
               blue));
    CHECK(
        near(at(picture(joined(square(0.5, {1, 0, 0, 0.6f}, faqem::AlphaMode::mask), back)), 0.5, 0.5), red));
}

TEST_CASE("vertex colours and the base colour factor are multiplied") {
    faqem::Asset asset = square(0, {1, 0.5f, 0.25f, 1});
    asset.parts[0].colors.assign(4, {0.5f, 0.5f, 1, 1});
    CHECK(near(at(picture(asset), 0.5, 0.5), Vector4f(0.5f, 0.25f, 0.25f, 1)));
}

TEST_CASE("both sides are lit, and edges are drawn only if enabled") {
    const faqem::Asset asset = square(0, {0.5f, 0.5f, 0.5f, 1});
    for (const double azimuth : {0.0, 3.14159265358979}) {
        const Vector4f c = at(picture(asset, Shading::lit, azimuth), 0.4, 0.5);
        CHECK(c[0] > 0.3f);
        CHECK(c[3] == 1);
    }
    // The diagonal edge is from the lower left to the upper right.
    const Frame wires = picture(asset, Shading::unlit, 0, Edges::drawn);
    CHECK(at(wires, 0.5, 0.5)[0] < 0.45f);
    CHECK(near(at(wires, 0.35, 0.3), Vector4f(0.5f, 0.5f, 0.5f, 1)));
}

TEST_CASE("an image that cannot be decoded is drawn white with a warning") {
    faqem::Asset asset = tool_test::sheet(1, 0);
    asset.images[0].encoded.resize(20);
    const Scene scene = make_scene(asset);
    CHECK(scene.warnings.size() == 1);
    CHECK(near(at(picture(asset), 0.25, 0.5), Vector4f(1, 1, 1, 1)));
}

TEST_CASE("a scene without faces has no bounding box") {
    CHECK(bounding_box(placed_meshes(make_scene(faqem::Asset{}))).isEmpty());
    const Scene scene = make_scene(tool_test::sheet(1, 0));
    const Eigen::AlignedBox3d box = bounding_box(placed_meshes(scene));
    CHECK(box.min() == Vector3(-1, -1, 0));
    CHECK(box.max() == Vector3(1, 1, 0));
}

TEST_CASE("the render command writes a sheet with a row per model and a column per view") {
    const tool_test::Folder folder;
    faqem::save(tool_test::sheet(6), folder / "a.glb");
    faqem::save(square(0, {0, 1, 0, 1}), folder / "b.glb");
    const auto outcome = tool_test::run(folder, "render a.glb b.glb out.png --size 40 --views 3 --unlit");
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    const std::string bytes = tool_test::read(folder / "out.png");
    faqem::Image image;
    image.encoded.assign(bytes.begin(), bytes.end());
    const faqem::Pixels sheet = faqem::decode(image);
    CHECK(sheet.width == 120);
    CHECK(sheet.height == 80);
    const auto pixel = [&](std::uint32_t x, std::uint32_t y) {
        return &sheet.rgba[(y * sheet.width + x) * 4];
    };
    CHECK(pixel(12, 20)[0] > 200);  // red, left half of the first view
    CHECK(pixel(12, 20)[2] < 60);
    CHECK(pixel(20, 60)[1] > 200);  // green below
    CHECK(pixel(20, 60)[0] < 60);
    CHECK(pixel(0, 0)[0] == pixel(0, 0)[1]);  // grey background
}
