#include "bake/page/texel_projector.hpp"

#include <algorithm>
#include <cmath>

#include "bake/source/vector_conversion.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;
using engine::Vector3;

// The right-angle corner has the same u as one of the other corners and the same v as the other one.
std::size_t right_angle_corner(const TrianglePlacement& placement) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 &r = placement.uv[i], &a = placement.uv[(i + 1) % 3], &b = placement.uv[(i + 2) % 3];
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

}  // namespace

TexelProjector::TexelProjector(const PageRequest& page, Index triangle)
    : face_(page.mesh.faces[triangle]),
      placement_(page.layout.atlas.placements[triangle]),
      frame_(placement_),
      right_angle_corner_(right_angle_corner(placement_)),
      part_(page.parts[face_.part]),
      triangle_(page.mesh.triangles[triangle]),
      texel_length_(texel_length()),
      spacing_(texel_length_ / page.samples),
      block_size_(std::max(1u, block_samples / page.samples)),
      box_(bounding_box(placement_.uv)),
      first_column_(static_cast<std::uint32_t>(std::max(box_.low.x, 0.0)) / block_size_),
      last_column_(static_cast<std::uint32_t>(std::max(box_.high.x, 0.0)) / block_size_) {
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
        const Point2& a = placement_.uv[0];
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
    if (is_single_texel())
        return {face_.face, s + t > 1 ? Vec3{s + t - 1, 1 - s, 1 - t} : Vec3{1 - s - t, s, t}, 0, x + s,
                y + t};
    const Vec3 w = frame_.at(x + s, y + t);
    for (std::size_t c = 0; c < 3; ++c) {
        if (w[c] < 0 && w[(c + 1) % 3] >= 0 && w[(c + 2) % 3] >= 0 && unfolded_[c].face != no_index) {
            return {unfolded_[c].face, weights_beyond(c, w), c + 1, x + s, y + t};
        }
    }
    return {face_.face, frame_.closest(x + s, y + t), 0, x + s, y + t};
}

// The block of texels around a sample.
TexelProjector::Block& TexelProjector::block_of(const TexelSample& at, std::uint32_t x, std::uint32_t y) {
    const std::uint32_t column = x / block_size_;
    std::vector<Block>& blocks = blocks_[at.cache_index];
    if (blocks.empty()) blocks.resize(last_column_ - first_column_ + 1);
    Block& block = blocks[std::clamp(column, first_column_, last_column_) - first_column_];
    block.move_to(column, y / block_size_);
    return block;
}

// \param size  of the block in texels
TexelProjector::Ball TexelProjector::ball_around(const Block& block, std::uint32_t size,
                                                 std::size_t cache_index) const {
    Box2 box{{double(block.column) * size, double(block.row) * size}, {}};
    box.high = {box.low.x + size, box.low.y + size};
    if (cache_index == 0) {
        const Box2 shared{{std::max(box.low.x, box_.low.x), std::max(box.low.y, box_.low.y)},
                          {std::min(box.high.x, box_.high.x), std::min(box.high.y, box_.high.y)}};
        if (shared.low.x < shared.high.x && shared.low.y < shared.high.y) box = shared;
    }
    const Vec3 w = frame_.at((box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2);
    return {cache_index == 0 ? w : weights_beyond(cache_index - 1, w),
            std::hypot(box.width(), box.height()) / 2 * texel_length_};
}

// Finds the faces of the source near the samples of a block that are on the same face as `at`.
void TexelProjector::prepare(Block& block, const TexelSample& at, const SurfacePoint& near) {
    const Ball ball = ball_around(block, block_size_, at.cache_index);
    if (at.cache_index == 0) {
        const std::uint32_t column = block.column / large_block, first = first_column_ / large_block,
                            last = last_column_ / large_block;
        if (large_blocks_.empty()) large_blocks_.resize(last - first + 1);
        Block& large = large_blocks_[std::clamp(column, first, last) - first];
        large.move_to(column, block.row / large_block);
        const Ball around = ball_around(large, large_block * block_size_, 0);
        if (around.radius > 1.5 * ball.radius) {
            if (large.samples == 0)
                large.map.prepare(*part_.map, at.face, around.centre, around.radius, near);
            large.samples = 1;
            if (block.map.prepare_from(*part_.map, at.face, ball.centre, ball.radius, large.map)) return;
        }
    }
    block.map.prepare(*part_.map, at.face, ball.centre, ball.radius, near);
}

SurfacePoint TexelProjector::map_near(const TexelSample& at, std::uint32_t x, std::uint32_t y,
                                      const SurfacePoint& near) {
    if (is_single_texel()) return part_.map->map_near(at.face, at.weights, near);
    Block& block = block_of(at, x, y);
    if (block.samples < single_samples) {
        if (++block.samples < single_samples) return part_.map->map_near(at.face, at.weights, near);
        prepare(block, at, near);
    }
    return block.map.map_near(*part_.map, at.face, at.weights, near);
}

SurfacePoint TexelProjector::project_to_source(const TexelSample& at, std::uint32_t x, std::uint32_t y) {
    WarmStartCache& cache = warm_starts_[at.cache_index];
    const SurfacePoint* near = cache.start_near(x, y);
    const SurfacePoint point = near ? map_near(at, x, y, *near) : part_.map->map(at.face, at.weights);
    cache.add(point, x, y);
    return point;
}

// Barycentric coordinates of the point of this triangle that is closest to a sample.
Vec3 TexelProjector::own_weights(const TexelSample& at) const {
    return at.cache_index == 0 ? at.weights : frame_.closest(at.x, at.y);
}

Vector3 TexelProjector::to_tangent_space(const TexelSample& at, const Vector3& normal) const {
    const TangentFrame here = blend_frames(frames_, own_weights(at));
    if (at.cache_index == 0) return here.from_mesh(normal);
    Vector3 there = Vector3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
        there += at.weights[i] * to_vector(part_.normals.normals[std::size_t{3} * at.face + i]);
    return here.from_mesh(Eigen::Quaterniond::FromTwoVectors(there, here.normal) * normal);
}

}  // namespace faqem::detail
