#include "cli/report/report_page.hpp"

#include <cmath>
#include <set>
#include <string_view>

#include "asset/gltf/gltf.hpp"
#include "cli/report/error_surface.hpp"
#include "cli/report/viewer_model.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace faqem::cli;
using namespace tool_test;

namespace {

bool has(const std::string& text, std::string_view piece) { return text.find(piece) != std::string::npos; }

/// Saves a sheet as a.glb, and one with fewer faces half a unit above it as b.glb.
void save_two(const Folder& folder) {
    faqem::Asset a = sheet(8, 0), b = sheet(2, 0);
    for (faqem::Vec3& p : b.parts[0].positions) p[2] += 0.5;
    faqem::save(a, folder / "a.glb");
    faqem::save(b, folder / "b.glb");
}

constexpr const char* small = " --size 16 --views 1 --samples 500";

}  // namespace

TEST_CASE("a report page contains figures and pictures and loads no external resources") {
    const Folder folder;
    save_two(folder);
    const Outcome outcome = run(folder, std::string("report a.glb b.glb -o page.html") + small);
    REQUIRE(outcome.code == 0);
    const std::string page = read(folder / "page.html");
    for (const char* piece : {"<th scope=\"row\">Faces</th><td>128</td><td>8</td><td>6.25%</td>",
                              "<th scope=\"row\">Mean</th><td>0.5 (17.7%)</td><td>0.5 (17.7%)</td>",
                              "8 faces instead of 128", "<th scope=\"row\">Root mean square</th>",
                              ": less than a pixel where the diagonal has up to ", "alt=\"The first model"}) {
        CAPTURE(piece);
        CHECK(has(page, piece));
    }
    std::size_t pictures = 0;
    for (std::size_t at = 0; (at = page.find("src=\"data:image/webp;base64,UklGR", at)) != std::string::npos;
         ++at)
        ++pictures;
    CHECK(pictures == 3);
    const auto models =
        static_cast<double>(fs::file_size(folder / "a.glb") + fs::file_size(folder / "b.glb"));
    CHECK(static_cast<double>(page.size()) <= 1.5 * models + 1.5e6);
    CHECK(!has(page, "src=\"http"));
    CHECK(!has(page, "<link"));
    CHECK(!has(page, "NAME_A"));
    CHECK(has(page, "id=\"canvas\"") == has_viewer());
    CHECK(has(outcome.err, "No 3D view") != has_viewer());
}

TEST_CASE("a report page with --without-view is small and has no script") {
    const Folder folder;
    save_two(folder);
    REQUIRE(run(folder, std::string("report a.glb b.glb page.html --without-view") + small).code == 0);
    const std::string page = read(folder / "page.html");
    CHECK(!has(page, "<script"));
    CHECK(!has(page, "id=\"canvas\""));
    CHECK(page.size() < 30'000);
}

TEST_CASE("file names are escaped in a report page") {
    const ModelFolder folder("<script>&.glb", sheet(2));
    REQUIRE(
        run(folder, std::string("report '<script>&.glb' '<script>&.glb' --without-view -o p.html") + small)
            .code == 0);
    CHECK(!has(read(folder / "p.html"), "<script>"));
    CHECK(has(read(folder / "p.html"), "&lt;script&gt;&amp;.glb"));
}

TEST_CASE("report writes only .html files") {
    const Folder folder;
    save_two(folder);
    CHECK(run(folder, "report a.glb b.glb -o page.pdf").code == 2);
    CHECK(run(folder, "report a.glb b.glb").code == 2);
    CHECK(run(folder, "report a.glb missing.glb -o other.html").code == 3);
}

TEST_CASE("viewer_glb writes the model and its error surface in normalized coordinates") {
    FlattenedModel model{"a.glb", sheet(1, 0), {}, {}};
    for (faqem::Vec3& p : model.asset.parts[0].positions) p[0] += 1e6;
    model.flat = model.asset.parts[0];
    ErrorSurface error{{}, {0, 1, 2, 4}};
    error.part.name = "error";
    error.part.positions = model.flat.positions;
    error.part.triangles = model.flat.triangles;
    const std::vector<std::uint8_t> bytes = viewer_glb(model, error, {{1e6, 0, 0}, 2, 4});
    const faqem::Asset read = faqem::detail::read_gltf(bytes, "view.glb");
    REQUIRE(read.parts.size() == 2);
    CHECK(read.parts[0].name == "look");
    const faqem::Instance shown =
        faqem::instances(read).at(0);  // positions are integers, and its node scales them
    std::set<double> lefts;
    for (const faqem::Vec3& p : read.parts[0].positions)
        lefts.insert(p[0] * shown.transform[0] + shown.transform[12]);
    CHECK(lefts == std::set<double>{-0.5, 0.5});
    CHECK(read.materials.size() == 2);  // that of the model, and one that is no metal
    CHECK(read.images.size() == 1);
    CHECK(read.parts[1].name == "error");
    std::set<float>
        roots;  // of the distances 0, 1, 2 and 4 as shares of 4; the third is no multiple of 2^-15
    for (const faqem::Vec2f& uv : read.parts[1].uvs[0]) roots.insert(uv[0]);
    CHECK(roots.size() == 4);
    for (const float root : {0.0f, 0.5f, 1.0f}) CHECK(roots.count(root) == 1);
}

TEST_CASE("heat_color increases in luminance and clamps its argument") {
    const auto luminance = [](double share) {
        const faqem::Vec4f c = heat_color(share);
        return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    };
    for (int i = 0; i < 16; ++i) CHECK(luminance(i / 16.0) < luminance((i + 1) / 16.0));
    CHECK(heat_color(2) == heat_color(1));
    CHECK(heat_color(-1) == heat_color(0));
    CHECK(heat_color(std::nan("")) == heat_color(0));
}

TEST_CASE("a report and a comparison weld corners that differ by rounding, and a note counts them") {
    const Folder folder;
    save_two(folder);
    faqem::Asset torn = faqem::load(folder / "a.glb");
    faqem::Part& part = torn.parts[0];
    faqem::Part soup;
    for (faqem::Triangle& t : part.triangles) {
        for (faqem::Index& v : t) {
            faqem::Vec3 p = part.positions[v];
            // Corners of every second face are one unit in the last place away.
            if (soup.triangles.size() % 2 == 1) p[0] = std::nextafter(static_cast<float>(p[0]), 9.0f);
            soup.positions.push_back(p);
            v = static_cast<faqem::Index>(soup.positions.size() - 1);
        }
        soup.triangles.push_back(t);
        soup.face_material.push_back(faqem::no_index);
    }
    part = soup;
    torn.source.reset();
    faqem::save(torn, folder / "torn.glb");
    const Outcome outcome = run(folder, std::string("report torn.glb a.glb -o page.html") + small);
    REQUIRE(outcome.code == 0);
    const std::string page = read(folder / "page.html");
    CHECK(has(page, "<th scope=\"row\">Components (connected pieces)</th><td>1</td><td>1</td>"));
    CHECK(has(page, "<th scope=\"row\">Vertices</th><td>81</td><td>81</td>"));
    CHECK(has(page, "torn.glb: part 0"));
    CHECK(has(page, "by rounding welded"));
}
