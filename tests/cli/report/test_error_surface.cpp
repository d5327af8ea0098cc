#include "cli/report/error_surface.hpp"

#include <cmath>
#include <limits>

#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"

using namespace faqem::cli;
using faqem::Part;

namespace {

/// A square of two faces, [-1, 1]^2 at the height z.
Part square(double z) {
    Part part;
    part.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
    part.triangles = {{0, 1, 2}, {0, 2, 3}};
    return part;
}

/// A pyramid of four faces over the same square.
Part roof(double height) {
    Part part = square(0);
    part.positions.push_back({0, 0, height});
    part.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    return part;
}

double area(const ErrorSurface& surface) {
    return faqem::info({surface.part.positions, surface.part.triangles}).area;
}

double longest_edge(const ErrorSurface& surface) {
    double longest = 0;
    for (const faqem::Triangle& t : surface.part.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const faqem::Vec3 &a = surface.part.positions[t[k]], &b = surface.part.positions[t[(k + 1) % 3]];
            longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
        }
    }
    return longest;
}

constexpr double undivided = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("error_surface computes the distance of each vertex to the other mesh") {
    const ErrorSurface surface = error_surface(square(0.25), square(0), undivided);
    CHECK(surface.part.triangles == square(0).triangles);
    CHECK(surface.distances == std::vector<double>(4, 0.25));
}

TEST_CASE("subdividing a face reveals the error between its corners") {
    const ErrorSurface corners = error_surface(square(0), roof(0.5), undivided);
    CHECK(distance_quantile(corners, corners, 1) == Approx(0).margin(1e-12));
    const ErrorSurface surface = error_surface(square(0), roof(0.5), 0.095);
    CHECK(longest_edge(surface) <= 0.095);
    // The maximum is at the centre of the square: the distance to faces that rise by 0.5 over a length of 1.
    CHECK(distance_quantile(surface, surface, 1) == Approx(0.5 / std::sqrt(1.25)));
}

TEST_CASE("subdivided faces preserve area, orientation and original vertices") {
    for (const double spacing : {2.9, 1.5, 0.7, 0.31}) {
        CAPTURE(spacing);
        const ErrorSurface surface = error_surface(roof(0.3), square(0), spacing);
        CHECK(area(surface) == Approx(area(error_surface(roof(0.3), square(0), undivided))));
        for (const faqem::Triangle& t : surface.part.triangles) {
            const faqem::Vec3 &a = surface.part.positions[t[0]], &b = surface.part.positions[t[1]],
                              &c = surface.part.positions[t[2]];
            CHECK((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
        }
        CHECK(std::vector(surface.part.positions.begin(), surface.part.positions.begin() + 5) ==
              roof(0.3).positions);
    }
}

TEST_CASE("error_surface adds at most a million faces for any spacing") {
    const ErrorSurface surface = error_surface(square(0), square(1), 1e-9);
    CHECK(surface.part.triangles.size() > 400'000);
    CHECK(surface.part.triangles.size() <= 1'000'002);
}

TEST_CASE("error_surface does not depend on the number of threads") {
    const ErrorSurface one = error_surface(square(0), roof(0.5), 0.02, 1),
                       four = error_surface(square(0), roof(0.5), 0.02, 4);
    CHECK(one.distances == four.distances);
}

TEST_CASE("distance_quantile returns quantiles of the distances of both surfaces") {
    ErrorSurface a, b;
    CHECK(distance_quantile(a, b, 0.5) == 0);
    a.distances = {4, 1};
    b.distances = {3, 2};
    CHECK(distance_quantile(a, b, 0) == 1);
    CHECK(distance_quantile(a, b, 0.5) == 2);
    CHECK(distance_quantile(a, b, 0.51) == 3);
    CHECK(distance_quantile(a, b, 1) == 4);
}

TEST_CASE("error_surface rejects a mesh without area") {
    Part flat = square(0);
    for (faqem::Vec3& p : flat.positions) p = {0, 0, 0};
    CHECK_THROWS_AS(error_surface(square(0), flat, undivided), faqem::InputError);
}
