#include "bake/atlas/packing.hpp"

#include <bit>
#include <cmath>

#include "bake/atlas/charts.hpp"
#include "bake/atlas/occupancy_grid.hpp"
#include "bake/atlas/tiles.hpp"
#include "support/catch.hpp"
#include "support/chart_meshes.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

struct Made {
    std::vector<PageTriangle> faces;
    Charts charts;
    ChartPage page;
};

Made made(const TriangleMesh& mesh, double density, std::uint32_t side = 1024) {
    Made result;
    result.faces = test::chart_faces(mesh, density);
    result.charts = make_charts(result.faces, 1);
    auto page = pack_charts(result.charts.charts, result.faces.size(), side);
    REQUIRE(page);
    result.page = *std::move(page);
    return result;
}

// By texel: the chart that owns it, -1 for none.
std::vector<int> owners(const ChartPage& page) {
    std::vector<int> result(std::size_t{page.atlas.width} * page.atlas.height, -1);
    for (std::size_t i = 0; i < page.charts.size(); ++i) {
        const AtlasChart& chart = page.charts[i];
        CHECK(std::has_single_bit(chart.block_size));
        CHECK((chart.x % chart.block_size == 0 && chart.y % chart.block_size == 0));
        REQUIRE(chart.x + chart.mask.columns * chart.block_size <= page.atlas.width);
        REQUIRE(chart.y + chart.mask.rows * chart.block_size <= page.atlas.height);
        for (std::uint32_t y = chart.y; y < chart.y + chart.mask.rows * chart.block_size; ++y) {
            for (std::uint32_t x = chart.x; x < chart.x + chart.mask.columns * chart.block_size; ++x) {
                if (!chart.owns(x, y)) continue;
                int& owner = result[std::size_t{y} * page.atlas.width + x];
                REQUIRE(owner == -1);
                owner = static_cast<int>(i);
            }
        }
    }
    return result;
}

// Checks that the texels of level 0 that contribute to a bilinear read of a chart belong to this chart, on
// all mip levels up to that of its block size.
void check_reads(const ChartPage& page, const std::vector<int>& owner) {
    const auto width = static_cast<int>(page.atlas.width), height = static_cast<int>(page.atlas.height);
    for (std::size_t i = 0; i < page.charts.size(); ++i) {
        const AtlasChart& chart = page.charts[i];
        for (int size = 1; size <= int(chart.block_size); size *= 2) {
            for (Index t : chart.triangles) {
                for (const Vec3& w : test::spread(5)) {
                    double x = -0.5, y = -0.5;
                    for (std::size_t c = 0; c < 3; ++c) {
                        x += w[c] * page.atlas.placements[t][c].x / size;
                        y += w[c] * page.atlas.placements[t][c].y / size;
                    }
                    for (int column = int(std::floor(x)); column < std::floor(x) + 2; ++column) {
                        for (int row = int(std::floor(y)); row < std::floor(y) + 2; ++row) {
                            if (!(std::abs(column - x) < 1 - 1e-6 && std::abs(row - y) < 1 - 1e-6)) continue;
                            const int left = column * size, top = row * size;
                            REQUIRE((left >= 0 && top >= 0 && left < width && top < height));
                            REQUIRE(owner[std::size_t(top) * std::size_t(width) + std::size_t(left)] ==
                                    int(i));
                            REQUIRE(owner[std::size_t(top + size - 1) * std::size_t(width) +
                                          std::size_t(left + size - 1)] == int(i));
                        }
                    }
                }
            }
        }
    }
}

// Twice the signed area of a triangle on the page, with v as y axis.
double page_orientation(const Triangle2& placement) {
    return twice_signed_area(placement[0], placement[1], placement[2]);
}

}  // namespace

TEST_CASE("bilinear reads of a chart use its own texels only up to the mip level of its block size") {
    const auto mesh =
        GENERATE(test::icosphere(3), test::cylinder(24, 3, 2), test::moebius(32, 3), test::soup(3, 40, 150));
    const double density = GENERATE(3.0, 40.0);
    const Made m = made(mesh, density);
    CHECK(std::has_single_bit(m.page.atlas.width));
    CHECK(std::has_single_bit(m.page.atlas.height));
    check_reads(m.page, owners(m.page));
}

TEST_CASE("triangles on a page are not mirrored and do not overlap") {
    const Made m = made(test::both(test::icosphere(2), test::moved(test::cylinder(16, 3, 2), {5, 0, 0})), 30);
    std::vector<Triangle2> flat;
    for (const Triangle2& placement : m.page.atlas.placements) {
        REQUIRE(page_orientation(placement) < 0);  // v points down
        Triangle2 t;
        for (std::size_t c = 0; c < 3; ++c) t[c] = {placement[c].x, -placement[c].y};
        flat.push_back(t);
    }
    CHECK(test::worst_overlap(flat) < 1e-6);
}

TEST_CASE("charts keep their shape at the scale of the page") {
    const Made m = made(test::icosphere(3), 30);
    CHECK(m.page.atlas.scale >= 1);
    CHECK(m.page.atlas.scale <= std::sqrt(2.0));
    for (std::size_t i = 0; i < m.page.charts.size(); ++i) {
        for (std::size_t k = 0; k < m.page.charts[i].triangles.size(); ++k) {
            const auto& uv = m.page.atlas.placements[m.page.charts[i].triangles[k]];
            for (std::size_t c = 0; c < 3; ++c) {
                const Point2 &a = uv[c], &b = uv[(c + 1) % 3];
                const double wanted =
                    length(m.charts.charts[i].points[k][c] - m.charts.charts[i].points[k][(c + 1) % 3]);
                CHECK(length(a - b) == Approx(m.page.atlas.scale * wanted));
            }
        }
    }
}

TEST_CASE("charts are scaled down to the largest page and need at least one texel each") {
    const auto mesh = test::soup(1, 100, 3000);
    const auto faces = test::chart_faces(mesh, 30);
    const Charts charts = make_charts(faces, 1);
    const auto small = pack_charts(charts.charts, faces.size(), 64);
    REQUIRE(small);
    CHECK(small->atlas.scale < 1);
    owners(*small);
    REQUIRE(charts.charts.size() > 16 * 16);
    CHECK_FALSE(pack_charts(charts.charts, faces.size(), 16));
}

TEST_CASE("a chart longer than the page is compressed") {
    TriangleMesh needle = test::make({{0, 0, 0}, {1000, 0, 0}, {1000, 0.001, 0}}, {{0, 1, 2}});
    const Made m = made(test::both(needle, test::square(2, 8, 1)), 8, 64);
    owners(m.page);
    CHECK(m.page.atlas.scale > 0.5);
    for (const Triangle2& placement : m.page.atlas.placements) {
        for (const Point2& uv : placement) CHECK((uv.x >= 0 && uv.x <= 64 && uv.y >= 0 && uv.y <= 64));
    }
}

TEST_CASE("samples of a chart are assigned to the triangle that contains them or to the closest one") {
    const Made m = made(test::cylinder(12, 2, 1), 20);
    constexpr std::uint32_t samples = 2;
    std::size_t inside = 0, outside = 0;
    for (const ChartTile& tile : split_into_tiles(m.page.charts)) {
        const AtlasChart& chart = m.page.charts[tile.chart];
        const TileOwners o = tile_owners(m.page.atlas, chart, m.faces, tile, samples);
        for (std::uint32_t j = 0; j < tile.height * samples; ++j) {
            for (std::uint32_t i = 0; i < tile.width * samples; ++i) {
                const std::uint32_t owner = o.owners[std::size_t{j} * tile.width * samples + i];
                const bool own = chart.owns(tile.x + i / samples, tile.y + j / samples);
                REQUIRE((owner != TileOwners::none) == own);
                if (!own) continue;
                const double x = tile.x + (i + 0.5) / samples, y = tile.y + (j + 0.5) / samples;
                const auto distance_to = [&](Index t) {
                    const BarycentricFrame frame(m.page.atlas.placements[t]);
                    const Vec3 w = frame.closest(x, y);
                    double dx = -x, dy = -y;
                    for (std::size_t c = 0; c < 3; ++c) {
                        dx += w[c] * m.page.atlas.placements[t][c].x;
                        dy += w[c] * m.page.atlas.placements[t][c].y;
                    }
                    return std::hypot(dx, dy);
                };
                double least = HUGE_VAL;
                for (Index t : chart.triangles) least = std::min(least, distance_to(t));
                CHECK(distance_to(o.triangles[owner]) == Approx(least).margin(1e-6));
                ++(least > 1e-9 ? outside : inside);
            }
        }
    }
    CHECK((inside > 1000 && outside > 100));
}

TEST_CASE("block masks can be rotated and are placed at the first free position") {
    const BlockMask mask{3, 2, {1, 1, 1, 1, 0, 0}};
    const BlockMask once = mask.rotated();
    CHECK((once.columns == 2 && once.rows == 3));
    CHECK(once.blocks == std::vector<std::uint8_t>{1, 1, 0, 1, 0, 1});
    CHECK(once.rotated().rotated().rotated().blocks == mask.blocks);
    OccupancyGrid grid(100, 8);
    for (std::uint32_t k = 0; k < 33; ++k) {  // the first row of masks, side by side
        const auto position = grid.find_free(mask, 0, 8, 1);
        REQUIRE(position);
        CHECK((position->y == 0 && position->x == 3 * k));
        grid.occupy(mask, *position);
    }
    const auto hole = grid.find_free({2, 1, {1, 1}}, 0, 8, 1);
    REQUIRE(hole);
    CHECK((hole->x == 1 && hole->y == 1));
    grid.refine();
    const auto fine = grid.find_free({4, 2, {1, 1, 1, 1, 1, 1, 1, 1}}, 0, 16, 1);
    REQUIRE(fine);
    CHECK((fine->x == 2 && fine->y == 2));
    CHECK_FALSE(grid.find_free({201, 1, std::vector<std::uint8_t>(201, 1)}, 0, 16, 1));
}

TEST_CASE("charts with coordinates out of range become one texel without affecting other charts") {
    const Made ball = made(test::icosphere(2), 10);
    for (const double far : {std::nan(""), HUGE_VAL, 1e300, 1e101}) {
        std::vector<Chart> charts = ball.charts.charts;
        const auto faces = static_cast<Index>(ball.faces.size());
        charts.push_back({{faces}, {{Point2{0, 0}, Point2{far, 0}, Point2{0, far}}}, 1, far});
        const auto page = pack_charts(charts, faces + 1u, 256);
        REQUIRE(page);
        CHECK(page->charts.size() == charts.size());
        owners(*page);
        for (const Triangle2& placement : page->atlas.placements) {
            for (const Point2& uv : placement) {
                CHECK((uv.x >= 0 && uv.x <= page->atlas.width));
                CHECK((uv.y >= 0 && uv.y <= page->atlas.height));
            }
        }
        CHECK(page->charts.back().is_single_texel);
    }
}

TEST_CASE("the page is the same for every number of threads") {
    const auto faces = test::chart_faces(test::soup(1, 100, 1000), 30);
    const Charts charts = make_charts(faces, 1);
    for (const std::uint32_t side : {64u, 2048u}) {  // scaled down, and up
        const auto expected = pack_charts(charts.charts, faces.size(), side, 1);
        REQUIRE(expected);
        for (const std::uint32_t threads : {2u, 5u}) {
            const auto page = pack_charts(charts.charts, faces.size(), side, threads);
            REQUIRE(page);
            CHECK(page->atlas.scale == expected->atlas.scale);
            REQUIRE(page->atlas.placements.size() == expected->atlas.placements.size());
            for (std::size_t i = 0; i < page->atlas.placements.size(); ++i)
                CHECK(page->atlas.placements[i] == expected->atlas.placements[i]);
        }
    }
}
