#include "bake/page/texel_projector.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

// The right-angle corner has the same u as one of the other corners and the same v as the other one.
std::size_t right_angle_corner(const Triangle2& placement) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 &r = placement[i], &a = placement[(i + 1) % 3], &b = placement[(i + 2) % 3];
        if ((r.x == a.x && r.y == b.y) || (r.y == a.y && r.x == b.x)) return i;
    }
    return 0;
}

// Samples of a block along each axis, about. More samples share a search for the faces near the block, but there are
// more of these faces.
constexpr std::uint32_t block_samples = 8;
// Blocks along each axis of a large block, whose faces are found together.
constexpr std::uint32_t large_block = 4;
// Samples of a block that are searched for one by one. With fewer samples than about twice as many, the search for
// the faces near the block would take longer than it saves.
constexpr std::uint32_t single_samples = 4;
// A list of so few faces is not worth dividing.
constexpr std::size_t short_list = 16;

// Side of a block in texels.
std::uint32_t block_size(const PageRequest& page) { return std::max(1u, block_samples / page.samples); }

// A convex polygon: a triangle cut along the sides of a box.
struct CutTriangle {
    std::array<Point2, 7> corners;
    std::size_t size = 0;

    // Removes what is beyond a line, where distance(p) is negative.
    template <class Distance>
    void cut(const Distance& distance) {
        CutTriangle result;
        for (std::size_t i = 0; i < size; ++i) {
            const Point2 &p = corners[i], &q = corners[(i + 1) % size];
            const double a = distance(p), b = distance(q);
            if (a >= 0) result.corners[result.size++] = p;
            if ((a >= 0) != (b >= 0)) result.corners[result.size++] = point_on_line(p, q, a / (a - b));
        }
        *this = result;
    }
};

CutTriangle cut_to(const Triangle2& triangle, const Box2& box) {
    CutTriangle result{{triangle[0], triangle[1], triangle[2]}, 3};
    result.cut([&](const Point2& p) { return p.x - box.low.x; });
    result.cut([&](const Point2& p) { return box.high.x - p.x; });
    result.cut([&](const Point2& p) { return p.y - box.low.y; });
    result.cut([&](const Point2& p) { return box.high.y - p.y; });
    return result;
}

}  // namespace

TexelProjector::TexelProjector(const PageRequest& page, Index triangle)
    : face_(page.mesh.faces[triangle]),
      placement_(page.layout.atlas.placements[triangle]),
      frame_(placement_),
      right_angle_corner_(right_angle_corner(placement_)),
      part_(page.parts[face_.part]),
      history_(part_.map->of_history()),
      triangle_(page.mesh.triangles[triangle]),
      texel_length_(texel_length()),
      spacing_(texel_length_ / page.samples),
      large_blocks_(large_block * block_size(page), bounding_box(placement_)) {
    blocks_.fill(BlockGrid(block_size(page), bounding_box(placement_)));
    const std::vector<Vec4f>& tangents = page.tangents[face_.part];
    for (std::size_t i = 0; i < 3 && !tangents.empty(); ++i) {
        const std::size_t c = std::size_t{3} * face_.face + i;
        frames_[i] = {to_vector(part_.normals.normals[c]), tangents[c]};
    }
    for (std::size_t c = 0; c < 3; ++c) {
        // Neighbours across a crease are not used: their colours would show in a strip one texel wide.
        if (triangle_.adjacent[c].triangle != no_index && !triangle_.crease[c])
            unfolded_[c] = unfold(c, page.mesh);
    }
}

// Length of the longer side of a texel on the simplified surface.
double TexelProjector::texel_length() const {
    if (is_single_texel()) return std::sqrt(area_vector(triangle_).norm() / 2);
    const auto at = [&](std::size_t i) { return to_eigen(triangle_.corners[i]); };
    const auto side_length = [&](double x, double y) {
        const Point2& a = placement_[0];
        const Vec3 w = frame_.at(a.x + x, a.y + y);
        return (w[1] * (at(1) - at(0)) + w[2] * (at(2) - at(0))).norm();
    };
    return std::max(side_length(1, 0), side_length(0, 1));
}

// Unfolds the neighbour across the edge opposite corner c.
TexelProjector::UnfoldedNeighbour TexelProjector::unfold(std::size_t c, const PageMesh& mesh) const {
    const auto [neighbour, other] = triangle_.adjacent[c];
    const Vector3 start = to_eigen(triangle_.corners[(c + 1) % 3]);
    const Vector3 edge = to_eigen(triangle_.corners[(c + 2) % 3]) - start;
    const Vector3 a = to_eigen(triangle_.corners[c]) - start;
    const Vector3 b = to_eigen(mesh.triangles[neighbour].corners[other]) - start;
    const double length = edge.squaredNorm(), foot = a.dot(edge) / length, other_foot = b.dot(edge) / length;
    const double height_ratio = (a - foot * edge).norm() / (b - other_foot * edge).norm();
    if (!std::isfinite(height_ratio) || !std::isfinite(foot) || !std::isfinite(other_foot)) return {};
    return {mesh.faces[neighbour].face, other, height_ratio, foot, other_foot};
}

// Barycentric coordinates on the neighbour across the edge opposite corner c, for a point with coordinates w of this
// triangle. The neighbour traverses the edge in the opposite direction. Points beyond the neighbour are clamped to it.
Vec3 TexelProjector::weights_beyond(std::size_t c, const Vec3& w) const {
    const UnfoldedNeighbour& neighbour = unfolded_[c];
    const double up = std::min(1.0, -w[c] * neighbour.height_ratio);
    const double along = w[(c + 2) % 3] + w[c] * neighbour.foot;
    const double end = std::clamp(along - up * neighbour.other_foot, 0.0, 1 - up);
    Vec3 result;
    result[neighbour.corner] = up;
    result[(neighbour.corner + 1) % 3] = end;
    result[(neighbour.corner + 2) % 3] = 1 - up - end;
    return result;
}

TexelSample TexelProjector::point(std::uint32_t x, std::uint32_t y, double s, double t) const {
    TexelSample result{.face = face_.face, .x = x + s, .y = y + t, .on_triangle = {x + s, y + t}};
    if (is_single_texel()) {
        result.on_own_triangle = true;
        result.weights = s + t > 1 ? Vec3{s + t - 1, 1 - s, 1 - t} : Vec3{1 - s - t, s, t};
        return result;
    }
    const Vec3 w = result.weights = frame_.at(x + s, y + t);
    result.on_own_triangle = w[0] >= 0 && w[1] >= 0 && w[2] >= 0;
    if (result.on_own_triangle) return result;
    for (std::size_t c = 0; c < 3; ++c) {
        if (w[c] < 0 && w[(c + 1) % 3] >= 0 && w[(c + 2) % 3] >= 0 && unfolded_[c].face != no_index) {
            result.face = unfolded_[c].face;
            result.weights = weights_beyond(c, w);
            result.cache_index = c + 1;
            return result;
        }
    }
    const Triangle2& uv = placement_;
    result.weights = frame_.closest(x + s, y + t);
    result.on_triangle = uv[0] * result.weights[0] + uv[1] * result.weights[1] + uv[2] * result.weights[2];
    return result;
}

TexelProjector::BlockGrid::BlockGrid(std::uint32_t size, const Box2& box)
    : size_(size),
      blocks_per_texel_(1 / size_),
      origin_{std::floor(box.low.x), std::floor(box.low.y)},
      columns_(1 + static_cast<std::int32_t>((box.high.x - origin_.x) / size_)),
      rows_(1 + static_cast<std::int32_t>((box.high.y - origin_.y) / size_)) {}

TexelProjector::Block& TexelProjector::BlockGrid::at(const Point2& p) {
    // Rounds down; std::floor() is a call of a function without SSE4.
    const auto number = [&](double texels) {
        const double blocks = texels * blocks_per_texel_;
        const auto truncated = static_cast<std::int32_t>(blocks);
        return truncated - (truncated > blocks);
    };
    const std::int32_t column = number(p.x - origin_.x), row = number(p.y - origin_.y);
    // The gutter is to the left and the right of the triangle too.
    if (blocks_.empty()) blocks_.resize(2 * (static_cast<std::size_t>(columns_) + 2));
    const auto slot = static_cast<std::size_t>(std::clamp(column + 1, 0, columns_ + 1));
    Block& block = blocks_[2 * slot + (row & 1)];
    block.move_to(column, row);
    return block;
}

Box2 TexelProjector::BlockGrid::box_of(const Block& block) const {
    const Point2 low = origin_ + Point2{block.column * size_, block.row * size_};
    return {low, low + Point2{size_, size_}};
}

// A ball around the part of the face in a box on which the samples like `at` are.
TexelProjector::Ball TexelProjector::ball_around(const Box2& box, const TexelSample& at) const {
    if (at.cache_index > 0) {
        const Vec3 middle = frame_.at((box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2);
        return {weights_beyond(at.cache_index - 1, middle),
                length({box.width(), box.height()}) / 2 * texel_length_};
    }
    const CutTriangle cut = cut_to(placement_, box);
    if (cut.size == 0) return {at.weights, box.width() * texel_length_};
    const auto position = [&](const Vec3& w) {
        return Vector3(w[0] * to_eigen(triangle_.corners[0]) + w[1] * to_eigen(triangle_.corners[1]) +
                       w[2] * to_eigen(triangle_.corners[2]));
    };
    std::array<Vector3, 7> corners;
    for (std::size_t i = 0; i < cut.size; ++i)
        corners[i] = position(frame_.at(cut.corners[i].x, cut.corners[i].y));
    const auto ball = [&](const Point2& centre) {
        Ball result{frame_.at(centre.x, centre.y), 0};
        const Vector3 middle = position(result.centre);
        for (std::size_t i = 0; i < cut.size; ++i)
            result.radius = std::max(result.radius, (corners[i] - middle).norm());
        return result;
    };
    // The ball is around the mean of the corners, or the middle of the two that are farthest from each other.
    Point2 sum, between = cut.corners[0];
    double longest = 0;
    for (std::size_t i = 0; i < cut.size; ++i) {
        sum = sum + cut.corners[i];
        for (std::size_t j = 0; j < i; ++j) {
            const double squared = (corners[i] - corners[j]).squaredNorm();
            if (!(squared > longest)) continue;
            longest = squared;
            between = point_on_line(cut.corners[i], cut.corners[j], 0.5);
        }
    }
    const Ball first = ball(sum * (1.0 / static_cast<double>(cut.size))), second = ball(between);
    return second.radius < first.radius ? second : first;
}

// Finds the faces of the source near the samples of a box that are on the same face as `at`.
// \param larger  prepared for a larger box; may be null
void TexelProjector::prepare(LocalMap& map, const Box2& box, const TexelSample& at, const SurfacePoint& near,
                             const LocalMap* larger) const {
    const Ball ball = ball_around(box, at);
    if (larger && map.prepare_from(*history_, at.face, ball.centre, ball.radius, *larger)) return;
    map.prepare(*history_, at.face, ball.centre, ball.radius, near);
}

// The map of the large block around a sample; null if there is none.
LocalMap* TexelProjector::large_map(const TexelSample& at, const SurfacePoint& near) {
    if (at.cache_index > 0 || blocks_[0].is_single()) return nullptr;
    Block& large = large_blocks_.at(at.on_triangle);
    if (large.samples++ == 0) prepare(large.map, large_blocks_.box_of(large), at, near, nullptr);
    return large.map.size() > 0 ? &large.map : nullptr;
}

SurfacePoint TexelProjector::map_near(const TexelSample& at, const SurfacePoint& near) {
    if (is_single_texel()) return history_->map_near(at.face, at.weights, near);
    const auto map_by = [&](LocalMap* map) {
        last_.map = map;
        return map->map_near(*history_, at.face, at.weights, near);
    };
    BlockGrid& grid = blocks_[at.cache_index];
    Block& block = grid.at(at.on_triangle);
    if (block.samples < single_samples) {
        LocalMap* const large = large_map(at, near);
        if (large && large->size() <= short_list) return map_by(large);
        if (++block.samples < single_samples)
            return large ? map_by(large) : history_->map_near(at.face, at.weights, near);
        prepare(block.map, grid.box_of(block), at, near, large);
    }
    return map_by(&block.map);
}

SurfacePoint TexelProjector::project_to_source(const TexelSample& at, std::uint32_t x, std::uint32_t y) {
    WarmStartCache& cache = warm_starts_[at.cache_index];
    const SurfacePoint* near = cache.start_near(x, y);
    const auto find = [&] {
        if (!history_) return part_.map->find(at.face, at.weights, near);
        if (near && last_.map && last_.cache_index == at.cache_index) {
            // Most samples have the same face of the source as the one before.
            const auto same = last_.map->map_to_same(*history_, at.face, at.weights, near->step);
            if (same) return *same;
        }
        last_ = {nullptr, at.cache_index};
        return near ? map_near(at, *near) : part_.map->map(at.face, at.weights);
    };
    const SurfacePoint point = find();
    if (point.face != no_index) cache.add(point, x, y);
    return point;
}

// Barycentric coordinates of the point of this triangle that is closest to a sample.
Vec3 TexelProjector::own_weights(const TexelSample& at) const {
    return at.cache_index == 0 ? at.weights : frame_.closest(at.x, at.y);
}

Vector3 TexelProjector::to_tangent_space(const TexelSample& at, const Vector3& normal) const {
    const TangentFrame here = blend_frames(frames_, own_weights(at));
    if (at.cache_index == 0) return here.from_mesh(normal);
    const Vector3 there = blended_normal(part_, at.face, at.weights);
    return here.from_mesh(Eigen::Quaterniond::FromTwoVectors(there, here.normal) * normal);
}

}  // namespace faqem::detail
