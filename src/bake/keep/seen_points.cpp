#include "bake/keep/seen_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "bake/atlas/point2.hpp"

namespace faqem::detail {
namespace {

using engine::Vector3;

// A vertex in a picture: pixels to the right and down, and the height above the plane of the picture.
struct PicturePoint {
    double x, y, height;
};

// A picture that is being drawn.
struct Drawing {
    std::uint32_t size;
    std::vector<SeenPoint> points;
    std::vector<double> heights;
};

// First and last pixel whose centre is between two coordinates; an empty range if there is none, or for NaN.
std::array<std::int64_t, 2> pixels_between(double low, double high, std::uint32_t size) {
    if (!(low <= high)) return {0, -1};
    const double last = size - 1.0;
    return {static_cast<std::int64_t>(std::clamp(std::ceil(low - 0.5), 0.0, last + 1)),
            static_cast<std::int64_t>(std::clamp(std::floor(high - 0.5), -1.0, last))};
}

// Draws a face at a pixel if it is nearer than what is there.
void draw_pixel(Drawing& drawing, Index mesh, Index face, const std::array<PicturePoint, 3>& p, double area,
                std::int64_t x, std::int64_t y) {
    const double at_x = static_cast<double>(x) + 0.5, at_y = static_cast<double>(y) + 0.5;
    Vec3 w;
    for (std::size_t k = 0; k < 3; ++k) {
        const PicturePoint &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
        w[k] = std::max(((b.x - a.x) * (at_y - a.y) - (at_x - a.x) * (b.y - a.y)) / area, 0.0);
    }
    const double sum = w[0] + w[1] + w[2];
    if (!(sum > 0)) return;
    for (double& weight : w) weight /= sum;
    const double height = w[0] * p[0].height + w[1] * p[1].height + w[2] * p[2].height;
    const auto pixel = static_cast<std::size_t>(y) * drawing.size + static_cast<std::size_t>(x);
    if (!(height > drawing.heights[pixel])) return;
    drawing.heights[pixel] = height;
    drawing.points[pixel] = {mesh, face, w};
}

void draw_face(Drawing& drawing, Index mesh, Index face, const std::array<PicturePoint, 3>& p) {
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (!(std::abs(area) > 0) || !std::isfinite(area)) return;
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const auto [top, bottom] = pixels_between(low, high, drawing.size);
    for (std::int64_t y = top; y <= bottom; ++y) {
        const auto [from, to] = crossing_range(p, static_cast<double>(y) + 0.5);
        const auto [left, right] = pixels_between(from, to, drawing.size);
        for (std::int64_t x = left; x <= right; ++x) draw_pixel(drawing, mesh, face, p, area, x, y);
    }
}

}  // namespace

std::vector<View> views_around(std::span<const PlacedMesh> meshes, std::size_t count, std::uint32_t size) {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const PlacedMesh& mesh : meshes) {
        for (const Vector3& p : mesh.positions) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
    }
    const double diameter = (high - low).norm();
    std::vector<View> result;
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<double>(i);
        const double height = 1 - (2 * at + 1) / static_cast<double>(count);
        const double radius = std::sqrt(1 - height * height);
        const Vector3 back(radius * std::sin(golden_angle * at), height,
                           radius * std::cos(golden_angle * at));
        const Vector3 right = Vector3::UnitY().cross(back).normalized();
        result.push_back({right, back.cross(right), back, (low + high) / 2, diameter / size, size});
    }
    return result;
}

std::vector<SeenPoint> seen_points(std::span<const PlacedMesh> meshes, const View& view) {
    const std::size_t pixels = std::size_t{view.size} * view.size;
    Drawing drawing{view.size, std::vector<SeenPoint>(pixels),
                    std::vector<double>(pixels, -std::numeric_limits<double>::infinity())};
    const double half = view.size / 2.0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        std::vector<PicturePoint> points;
        points.reserve(meshes[m].positions.size());
        for (const Vector3& position : meshes[m].positions) {
            const Vector3 p = (position - view.center) / view.pixel;
            points.push_back({half + p.dot(view.right), half - p.dot(view.up), p.dot(view.back)});
        }
        for (std::size_t f = 0; f < meshes[m].triangles.size(); ++f) {
            const Triangle& t = meshes[m].triangles[f];
            draw_face(drawing, static_cast<Index>(m), static_cast<Index>(f),
                      {points[t[0]], points[t[1]], points[t[2]]});
        }
    }
    return std::move(drawing.points);
}

}  // namespace faqem::detail
