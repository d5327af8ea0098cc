#include "bake/atlas/charts.hpp"

#include <random>
#include <set>

#include "bake/atlas/packing.hpp"
#include "bake/atlas/parametrization.hpp"
#include "bake/atlas/segmentation.hpp"
#include "bake/atlas/triangle_overlap.hpp"
#include "support/catch.hpp"
#include "support/chart_meshes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

constexpr std::uint64_t plenty = 1000000000;

std::vector<Index> all_of(std::size_t n) {
    std::vector<Index> result(n);
    for (Index i = 0; i < n; ++i) result[i] = i;
    return result;
}

// The charts of faces, whose invariants for any input are checked.
Charts checked_charts(const std::vector<PageTriangle>& faces) {
    Charts charts = make_charts(faces, 1);
    std::vector<int> seen(faces.size(), 0);
    for (const Chart& chart : charts.charts) {
        REQUIRE(chart.points.size() == chart.faces.size());
        CHECK(std::is_sorted(chart.faces.begin(), chart.faces.end()));
        CHECK(chart.stretch >= 1 - 1e-9);
        CHECK(chart.stretch <= 1.06);
        for (Index f : chart.faces) ++seen[f];
        for (const Triangle2& t : chart.points) REQUIRE(twice_signed_area(t[0], t[1], t[2]) > 0);
        CHECK(test::worst_overlap(chart.points) < 1e-6);
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
    return charts;
}

// Largest relative difference between the lengths of an edge in its chart and on the surface.
double worst_edge(const std::vector<PageTriangle>& faces, const Charts& charts) {
    double worst = 0;
    for (const Chart& chart : charts.charts) {
        for (std::size_t i = 0; i < chart.faces.size(); ++i) {
            const PageTriangle& face = faces[chart.faces[i]];
            for (std::size_t c = 0; c < 3; ++c) {
                const Vec3 d = test::minus(face.corners[c], face.corners[(c + 1) % 3]);
                const double wanted = face.density * std::hypot(d[0], d[1], d[2]);
                const double flat = length(chart.points[i][c] - chart.points[i][(c + 1) % 3]);
                worst = std::max(worst, std::abs(flat / wanted - 1));
            }
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("the sides of a cube are at most six charts without distortion") {
    const auto faces = test::chart_faces(test::cube(), 10);
    const Charts charts = checked_charts(faces);
    CHECK(worst_edge(faces, charts) < 1e-9);
    // Without creases several sides can be in one chart.
    CHECK(charts.charts.size() <= 6);
    auto creased = faces;
    for (PageTriangle& face : creased) {
        for (std::size_t c = 0; c < 3; ++c) {
            const auto n = [](const PageTriangle& f) {
                return engine::area_vector(engine::to_eigen(f.corners[0]), engine::to_eigen(f.corners[1]),
                                           engine::to_eigen(f.corners[2]));
            };
            face.crease[c] = n(face).dot(n(faces[face.adjacent[c].triangle])) == 0;
        }
    }
    const Charts sides = checked_charts(creased);
    CHECK(sides.charts.size() == 6);
}

TEST_CASE("a flat square that fills the page is one chart, on a square page") {
    const Index n = GENERATE(1, 5);
    const auto faces = test::chart_faces(test::grid(n), 181.0 / n);
    const Charts charts = make_charts(faces, 1);
    CHECK(charts.charts.size() == 1);
    const std::optional<ChartPage> page = pack_charts(charts.charts, faces.size(), 1024, 1);
    REQUIRE(page);
    CHECK(page->atlas.width == page->atlas.height);
}

TEST_CASE("a cylinder is unrolled without distortion") {
    const auto faces = test::chart_faces(test::cylinder(48, 6, 2), 20);
    const Charts charts = checked_charts(faces);
    CHECK(worst_edge(faces, charts) < 1e-6);
    CHECK(charts.charts.size() < 8);
}

TEST_CASE("a sphere has few charts with low stretch") {
    const auto faces = test::chart_faces(test::icosphere(3), 40);
    const Charts charts = checked_charts(faces);
    CHECK(charts.charts.size() < 16);
}

TEST_CASE("a Moebius strip is cut into few charts") {
    const auto faces = test::chart_faces(test::moebius(48, 4), 40);
    const Charts charts = checked_charts(faces);
    CHECK(charts.charts.size() > 1);
    CHECK(charts.charts.size() < 16);
}

TEST_CASE("a helical surface does not overlap itself") {
    // Three turns above each other, all facing up.
    TriangleMesh mesh;
    for (Index i = 0; i <= 96; ++i) {
        const double a = 2 * test::pi * i / 32;
        for (const double r : {1.0, 1.5})
            mesh.positions.push_back({r * std::cos(a), r * std::sin(a), 0.01 * i});
        if (i == 96) continue;
        mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
        mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
    }
    const auto faces = test::chart_faces(mesh, 20);
    const Charts charts = checked_charts(faces);
    CHECK(charts.charts.size() > 1);
}

TEST_CASE("charts of triangle soup, duplicate and degenerate faces are valid") {
    TriangleMesh mesh = test::soup(3, 60, 400);
    mesh.triangles.push_back(mesh.triangles.front());
    mesh.triangles.push_back({0, 1, 0});
    mesh.positions[5] = mesh.positions[6];
    const Index line = static_cast<Index>(mesh.positions.size());
    for (int i = 0; i < 3; ++i) mesh.positions.push_back({double(i), 0, 0});
    mesh.triangles.push_back({line, line + 1, line + 2});
    mesh.triangles.push_back({line, line, line});
    const auto faces = test::chart_faces(mesh, 30);
    checked_charts(faces);
}

TEST_CASE("charts have at most max_faces_per_chart faces") {
    const auto faces = test::chart_faces(test::grid(70), 1);
    REQUIRE(faces.size() > max_faces_per_chart);
    const Charts charts = checked_charts(faces);
    CHECK(charts.faces_over_work_limit == 0);
    CHECK(charts.charts.size() < 8);
    for (const Chart& chart : charts.charts) CHECK(chart.faces.size() <= max_faces_per_chart);
}

TEST_CASE("faces whose densities differ by more than a factor of two are in different regions") {
    auto faces = test::chart_faces(test::grid(8), 10);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (faces[f].corners[0][0] + faces[f].corners[1][0] + faces[f].corners[2][0] > 12)
            faces[f].density = 25;
    }
    for (const std::vector<Index>& region : cluster_faces(faces)) {
        for (Index f : region) CHECK(faces[f].density == faces[region[0]].density);
    }
}

TEST_CASE("charts do not depend on the number of threads") {
    // On the second mesh so many merges fail that their work limit is reached.
    for (const TriangleMesh& mesh :
         {test::shaken(test::torus(40, 20), 0.01, 5), test::shaken(test::torus(40, 20), 0.1, 5)}) {
        const auto faces = test::chart_faces(mesh, 30);
        const Charts one = checked_charts(faces), three = make_charts(faces, 3);
        REQUIRE(one.charts.size() == three.charts.size());
        for (std::size_t i = 0; i < one.charts.size(); ++i) {
            CHECK(one.charts[i].faces == three.charts[i].faces);
            CHECK(one.charts[i].points == three.charts[i].points);
        }
    }
}

TEST_CASE("charts have the wanted area") {
    const auto faces = test::chart_faces(test::globe(6, 1), 10);
    for (const Chart& chart : make_charts(faces, 1).charts) {
        double flat = 0, wanted = 0;
        for (const Triangle2& t : chart.points) flat += twice_signed_area(t[0], t[1], t[2]) / 2;
        for (Index f : chart.faces) wanted += wanted_texels(faces[f]);
        CHECK(chart.texels == Approx(wanted));
        if (chart.faces.size() > 1) CHECK(flat == Approx(wanted));
    }
}

TEST_CASE("overlapping triangles are detected and touching ones are accepted") {
    const Triangle2 a = {Point2{0, 0}, {4, 0}, {0, 4}};
    std::uint64_t work = plenty;
    CHECK(have_disjoint_interiors(std::vector<Triangle2>{a, {Point2{4, 0}, {4, 4}, {0, 4}}}, work));
    CHECK_FALSE(have_disjoint_interiors(std::vector<Triangle2>{a, a}, work));
    CHECK_FALSE(have_disjoint_interiors(std::vector<Triangle2>{a, {Point2{1, 1}, {1.1, 1}, {1, 1.1}}}, work));
    CHECK_FALSE(have_disjoint_interiors(std::vector<Triangle2>{a, {Point2{-1, 1}, {9, 1}, {9, 1.1}}}, work));
    CHECK_FALSE(have_disjoint_interiors(std::vector<Triangle2>{a, {Point2{NAN, 1}, {9, 1}, {9, 1.1}}}, work));
}

TEST_CASE("have_disjoint_interiors agrees with the intersection areas of random triangles") {
    std::mt19937 random(11);
    const auto number = [&] { return (random() % 1000) / 100.0; };
    int overlapping = 0;
    for (int round = 0; round < 300; ++round) {
        std::vector<Triangle2> triangles;
        while (triangles.size() < 3) {
            const Point2 at = {3 * number(), 3 * number()};
            const Triangle2 t = {at, at + Point2{number(), number()}, at + Point2{-number(), number()}};
            if (twice_signed_area(t[0], t[1], t[2]) > 1e-3) triangles.push_back(t);
        }
        std::uint64_t work = plenty;
        const bool expected = test::worst_overlap(triangles) < 1e-9;
        CHECK(have_disjoint_interiors(triangles, work) == expected);
        overlapping += !expected;
    }
    CHECK((overlapping > 50 && overlapping < 250));
}

TEST_CASE("an overlap among many triangles is found wherever it is") {
    std::vector<Triangle2> triangles;
    for (std::size_t i = 0; i < 200; ++i) {
        const Point2 at = {static_cast<double>(i % 20), 2 * std::floor(static_cast<double>(i) / 20)};
        triangles.push_back({at, at + Point2{0.9, 0}, at + Point2{0.3, 1.7}});
    }
    std::uint64_t work = plenty;
    CHECK(have_disjoint_interiors(triangles, work));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        std::vector<Triangle2> moved = triangles;
        moved[i] = triangles[(77 * i + 1) % triangles.size()];
        work = plenty;
        CHECK_FALSE(have_disjoint_interiors(moved, work));
    }
}

TEST_CASE("a parametrization beyond the work limit is reported as overlapping") {
    const auto faces = test::chart_faces(test::grid(6), 10);
    std::uint64_t work = parametrization_work_per_face * faces.size() + 10;
    CHECK(parametrize(faces, all_of(faces.size()), work).outcome == Parametrization::Outcome::overlapping);
    CHECK(work == 0);
    work = plenty;
    CHECK(parametrize(faces, all_of(faces.size()), work).outcome == Parametrization::Outcome::valid);
}

TEST_CASE("bisect returns two connected halves") {
    const auto faces = test::chart_faces(test::grid(9), 1);
    const auto halves = bisect(faces, all_of(faces.size()));
    std::set<Index> seen;
    for (const auto& half : halves) {
        CHECK(half.size() == faces.size() / 2);
        CHECK(connected_subsets(faces, half).size() == 1);
        seen.insert(half.begin(), half.end());
    }
    CHECK(seen.size() == faces.size());
}
