#include "bake/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bake/directions.hpp"
#include "bake/fill.hpp"
#include "bake/normals.hpp"
#include "bake/trail.hpp"
#include "faqem/engine/vector.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;
using engine::Vector3;

// Below this a texel's colour is that of texels around it.
constexpr float clear = 1.0f / 512;

constexpr std::size_t texels_per_poll = 4096;

Pixels blank(const Atlas& atlas, bool wanted, bool has_alpha, Poll poll) {
    if (!wanted) return {};
    poll.now();
    const std::size_t texels = std::size_t{atlas.width} * atlas.height;
    return {atlas.width, atlas.height, std::vector<std::uint8_t>(4 * texels, 255), has_alpha};
}

// Sums of samples.
struct Texel {
    Linear base{};
    std::array<float, 3> orm{};
    Vec3f emissive{};
    Vector3 normal = Vector3::Zero();     // in tangent space
    std::array<std::uint8_t, 3> steps{};  // samples by MapStep
    TexelOrigin origin;                   // of the sample next to the middle
    double off_middle = std::numeric_limits<double>::infinity();

    void add(const Appearance& a, float share) {
        for (std::size_t k = 0; k < 4; ++k) base[k] += share * a.base[k];
        orm[0] += share * a.occlusion;
        orm[1] += share * a.roughness;
        orm[2] += share * a.metallic;
        for (std::size_t k = 0; k < 3; ++k) emissive[k] += share * a.emissive[k];
    }
};

class Page {
public:
    Page(const BakeJob& job, const SourceSurface& surface, const PageRequest& request)
        : job_(job), surface_(surface), request_(request), samples_(job.options.bake.samples) {
        const Atlas& atlas = request.atlas;
        const Channels& channels = request.channels;
        const Poll poll = job.poll();
        images_.base = blank(atlas, channels.base, request.alpha_mode != AlphaMode::opaque, poll);
        images_.occlusion_roughness_metallic =
            blank(atlas, channels.occlusion || channels.metallic_roughness, false, poll);
        images_.emissive = blank(atlas, channels.emissive, false, poll);
        images_.normal = blank(atlas, channels.normal, false, poll);
        known_.assign(std::size_t{atlas.width} * atlas.height, 0);
        relaxed_.assign(known_.size(), 0);
        closest_.assign(known_.size(), 0);
        if (job.options.bake.correspondence == Recording::on) images_.origins.resize(known_.size());
        if (images_.base.has_alpha) opaque_.assign(known_.size(), 0);
    }

    void bake(const AtlasCell& cell, Poll poll) {
        Painter first(*this, cell.first);
        if (cell.second == no_index) {
            bake_texels(cell, poll, [&](double, double) -> Painter& { return first; });
            return;
        }
        // The two face each other with their hypotenuses and have the same legs: the weights of their right
        // corners tell which one is nearer.
        Painter second(*this, cell.second);
        bake_texels(cell, poll, [&](double x, double y) -> Painter& {
            return second.frame.at(x, y)[second.right] > first.frame.at(x, y)[first.right] ? second : first;
        });
    }

    void bake(const ChartTile& tile, Poll poll) {
        const TileOwners owned =
            tile_owners(request_.atlas, request_.charts[tile.chart], request_.across, tile, samples_);
        std::vector<Painter> painters;
        painters.reserve(owned.triangles.size());
        for (Index t : owned.triangles) painters.emplace_back(*this, t);
        for (std::uint32_t y = 0; y < tile.height; ++y) {
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                const std::size_t first = (std::size_t{y} * tile.width * samples_ + x) * samples_;
                if (owned.owners[first] == TileOwners::none) continue;
                poll(samples_ * samples_);
                Texel sum;
                for (std::uint32_t j = 0; j < samples_; ++j) {
                    for (std::uint32_t i = 0; i < samples_; ++i) {
                        const double s = (i + 0.5) / samples_, t = (j + 0.5) / samples_;
                        Painter& painter =
                            painters[owned.owners[first + std::size_t{j} * tile.width * samples_ + i]];
                        add_sample(sum, painter, tile.x + x, tile.y + y,
                                   painter.point(tile.x + x, tile.y + y, s, t));
                    }
                }
                write(tile.x + x, tile.y + y, sum);
            }
        }
    }

    PageImages finish() {
        count_samples();
        const std::array all = {&images_.base, &images_.occlusion_roughness_metallic, &images_.emissive,
                                &images_.normal};
        parallel_blocks(all.size(), 1, job_.workers(), [&](std::size_t i, std::size_t, Poll poll) {
            Pixels& image = *all[i];
            if (image.rgba.empty()) return;
            push_pull(image, image.has_alpha ? opaque_ : known_, {0, 3}, poll);
            if (image.has_alpha) push_pull(image, known_, {3, 4}, poll);
        });
        return std::move(images_);
    }

private:
    // A point on a face of the small mesh.
    struct SmallPoint {
        Index face = 0;
        Vec3 weights = {};
        std::size_t trail = 0;
        double x = 0, y = 0;  // on the page
    };

    // A triangle, its neighbours, and where its last samples were.
    struct Painter {
        Painter(const Page& page, Index triangle)
            : face(page.request_.faces[triangle]),
              place(page.request_.atlas.places[triangle]),
              frame(place),
              right(right_corner(place)),
              part(page.job_.parts[face.part]),
              normals_of_part(page.job_.normals[face.part]),
              mesh(part.small->mesh),
              map(*part.map),
              spacing(texel_length() / page.samples_) {
            if (page.request_.channels.normal) set_frames(page);
            for (std::size_t c = 0; c < 3; ++c) {
                const Across& across = page.request_.across[triangle][c];
                if (across.triangle == no_index) continue;
                const Index other = page.request_.faces[across.triangle].face;
                // Beyond a crease another side begins, whose colours would run into a strip a texel wide.
                if (!is_crease(normals_of_part, face.face, c, other, across.corner)) {
                    folds[c] = fold(c, other, across.corner);
                }
            }
        }

        void set_frames(const Page& page) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t c = std::size_t{3} * face.face + i;
                frames[i] = {to_vector(normals_of_part.normals[c]), page.request_.tangents[face.part][c]};
            }
        }

        // The source's normal where the last sample was, in tangent space. One that lies across an edge is
        // turned with its face into this triangle's plane: at a crease it would lean over by the whole fold.
        Vector3 bent_normal(const SourceSurface& surface, const SmallPoint& at) const {
            const TangentFrame here = blend_frames(frames, own_weights(at));
            const Vector3 side = face_side(part, normals_of_part, at.face);
            const Vector3 normal = surface.normal(face.part, trails[at.trail].last(), spacing, side);
            if (at.trail == 0) return here.from_mesh(normal);
            Vector3 there = Vector3::Zero();
            for (std::size_t i = 0; i < 3; ++i) {
                there += at.weights[i] * to_vector(normals_of_part.normals[std::size_t{3} * at.face + i]);
            }
            return here.from_mesh(Eigen::Quaterniond::FromTwoVectors(there, here.normal) * normal);
        }

        // The right corner is the one whose UV is level with one other corner and plumb with the other.
        static std::size_t right_corner(const AtlasPlace& place) {
            for (std::size_t i = 0; i < 3; ++i) {
                const auto &r = place.uv[i], &a = place.uv[(i + 1) % 3], &b = place.uv[(i + 2) % 3];
                if ((r[0] == a[0] && r[1] == b[1]) || (r[1] == a[1] && r[0] == b[0])) return i;
            }
            return 0;
        }

        engine::Vector3 corner(Index f, std::size_t i) const {
            return to_eigen(mesh.positions[mesh.triangles[f][i % 3]]);
        }

        // Length of a texel on the small surface, the longer one of its sides.
        double texel_length() const {
            const auto at = [&](std::size_t i) { return corner(face.face, i); };
            if (single()) return std::sqrt(engine::area_vector(at(0), at(1), at(2)).norm() / 2);
            const auto side = [&](double x, double y) {
                const auto& a = place.uv[0];
                const Vec3 w = frame.at(a[0] + x, a[1] + y);
                return (w[1] * (at(1) - at(0)) + w[2] * (at(2) - at(0))).norm();
            };
            return std::max(side(1, 0), side(0, 1));
        }

        bool single() const { return place.uv[0] == place.uv[1]; }

        // How weights of this face become weights of the neighbour across an edge, unfolded into one plane.
        struct Fold {
            Index face = no_index;
            std::size_t corner = 0;           // of the neighbour, opposite the edge
            double heights = 0;               // this face's over the neighbour's, above the edge
            double foot = 0, other_foot = 0;  // of the corners opposite, along the edge, 0 to 1
        };

        Fold fold(std::size_t c, Index neighbour, std::size_t other) const {
            const engine::Vector3 start = corner(face.face, c + 1);
            const engine::Vector3 edge = corner(face.face, c + 2) - start;
            const engine::Vector3 a = corner(face.face, c) - start, b = corner(neighbour, other) - start;
            const double length = edge.squaredNorm(), foot = a.dot(edge) / length,
                         other_foot = b.dot(edge) / length;
            const double heights = (a - foot * edge).norm() / (b - other_foot * edge).norm();
            if (!std::isfinite(heights) || !std::isfinite(foot) || !std::isfinite(other_foot)) return {};
            return {neighbour, other, heights, foot, other_foot};
        }

        // The point for place (s, t) of texel (x, y).
        SmallPoint point(std::uint32_t x, std::uint32_t y, double s, double t) const {
            if (single())
                return {face.face, s + t > 1 ? Vec3{s + t - 1, 1 - s, 1 - t} : Vec3{1 - s - t, s, t}, 0,
                        x + s, y + t};
            const Vec3 w = frame.at(x + s, y + t);
            for (std::size_t c = 0; c < 3; ++c) {
                if (w[c] < 0 && w[(c + 1) % 3] >= 0 && w[(c + 2) % 3] >= 0 && folds[c].face != no_index) {
                    return {folds[c].face, across(folds[c], w, c), c + 1, x + s, y + t};
                }
            }
            return {face.face, frame.closest(x + s, y + t), 0, x + s, y + t};
        }

        // The neighbour runs along the edge the other way. What is outside of it too is drawn in.
        static Vec3 across(const Fold& fold, const Vec3& w, std::size_t c) {
            const double up = std::min(1.0, -w[c] * fold.heights);
            const double along = w[(c + 2) % 3] + w[c] * fold.foot;
            const double end = std::clamp(along - up * fold.other_foot, 0.0, 1 - up);
            Vec3 result;
            result[fold.corner] = up;
            result[(fold.corner + 1) % 3] = end;
            result[(fold.corner + 2) % 3] = 1 - up - end;
            return result;
        }

        // Weights of the point of this triangle that is closest to a sample.
        Vec3 own_weights(const SmallPoint& at) const {
            return at.trail == 0 ? at.weights : frame.closest(at.x, at.y);
        }

        const PageFace face;
        const AtlasPlace& place;
        const AtlasFrame frame;
        const std::size_t right;
        const SmallPart& part;
        const CornerNormals& normals_of_part;
        const TriangleMesh& mesh;
        const SurfaceMap& map;
        const double spacing;
        std::array<Fold, 3> folds;          // by corner opposite
        std::array<FrameCorner, 3> frames;  // for the normal map
        std::array<Trail, 4> trails;        // the triangle's own, then those across
    };

    // Texels between strangers belong to one of them; one on the hypotenuse of partners is both's.
    template <class Choose>
    void bake_texels(const AtlasCell& cell, Poll poll, Choose&& choose) {
        for (std::uint32_t y = cell.y; y < cell.y + cell.height; ++y) {
            for (std::uint32_t x = cell.x; x < cell.x + cell.width; ++x) {
                poll(samples_ * samples_);
                Texel sum;
                for (std::uint32_t j = 0; j < samples_; ++j) {
                    for (std::uint32_t i = 0; i < samples_; ++i) {
                        const double s = (i + 0.5) / samples_, t = (j + 0.5) / samples_;
                        Painter& painter = cell.joined ? choose(x + s, y + t) : choose(x + 0.5, y + 0.5);
                        add_sample(sum, painter, x, y, painter.point(x, y, s, t));
                    }
                }
                write(x, y, sum);
            }
        }
    }

    void add_sample(Texel& sum, Painter& painter, std::uint32_t x, std::uint32_t y,
                    const SmallPoint& at) const {
        Trail& trail = painter.trails[at.trail];
        const SurfacePoint* near = trail.to(x, y);
        const SurfacePoint point =
            near ? painter.map.map_near(at.face, at.weights, *near) : painter.map.map(at.face, at.weights);
        trail.add(point, x, y);
        ++sum.steps[static_cast<std::size_t>(point.step)];
        sum.add(surface_.sample(painter.face.part, point, painter.spacing),
                1.0f / static_cast<float>(samples_ * samples_));
        const double off_middle = std::hypot(at.x - x - 0.5, at.y - y - 0.5);
        if (off_middle < sum.off_middle) {
            sum.off_middle = off_middle;
            sum.origin = {painter.face.part, point};
        }
        if (request_.channels.normal) sum.normal += painter.bent_normal(surface_, at);
    }

    void write(std::uint32_t x, std::uint32_t y, const Texel& texel) {
        const std::size_t at = std::size_t{y} * request_.atlas.width + x;
        known_[at] = 1;
        relaxed_[at] = texel.steps[static_cast<std::size_t>(MapStep::relaxed)];
        closest_[at] = texel.steps[static_cast<std::size_t>(MapStep::closest)];
        if (!images_.origins.empty()) images_.origins[at] = texel.origin;
        if (request_.channels.base) {
            const float alpha = texel.base[3];
            std::uint8_t* p = &images_.base.rgba[4 * at];
            for (std::size_t k = 0; k < 3; ++k) p[k] = alpha > clear ? srgb_byte(texel.base[k] / alpha) : 0;
            p[3] = linear_byte(alpha);
            if (!opaque_.empty()) opaque_[at] = alpha > clear;
        }
        if (!images_.occlusion_roughness_metallic.rgba.empty()) {
            std::uint8_t* p = &images_.occlusion_roughness_metallic.rgba[4 * at];
            for (std::size_t k = 0; k < 3; ++k) p[k] = linear_byte(texel.orm[k]);
        }
        if (request_.channels.emissive) {
            std::uint8_t* p = &images_.emissive.rgba[4 * at];
            for (std::size_t k = 0; k < 3; ++k) p[k] = srgb_byte(texel.emissive[k]);
        }
        if (request_.channels.normal) {
            const double length = texel.normal.norm();
            const Vector3 n = length > 1e-6 ? Vector3(texel.normal / length) : Vector3(0, 0, 1);
            std::uint8_t* p = &images_.normal.rgba[4 * at];
            for (Eigen::Index k = 0; k < 3; ++k) p[k] = linear_byte((n[k] + 1) / 2);
        }
    }

    void count_samples() {
        const Poll poll = job_.poll();
        auto& [history, relaxed, closest] = images_.samples;
        for (std::size_t i = 0; i < known_.size(); ++i) {
            if (i % texels_per_poll == 0) poll(texels_per_poll / 16);
            images_.texels += known_[i];
            history += known_[i] * (samples_ * samples_ - relaxed_[i] - closest_[i]);
            relaxed += relaxed_[i];
            closest += closest_[i];
            images_.uncertain_texels += relaxed_[i] + closest_[i] > 0;
        }
    }

    const BakeJob& job_;
    const SourceSurface& surface_;
    const PageRequest& request_;
    std::uint32_t samples_;
    PageImages images_;
    std::vector<std::uint8_t> relaxed_, closest_;  // samples of each texel that were found so
    std::vector<std::uint8_t> known_;              // texels in cells
    std::vector<std::uint8_t> opaque_;             // those with a colour
};

}  // namespace

PageImages bake_page(const BakeJob& job, const SourceSurface& surface, const PageRequest& request,
                     double done, double total) {
    Page page(job, surface, request);
    const auto bake_all = [&](const auto& pieces, std::size_t block) {
        polled_blocks(job, Phase::bake, pieces.size(), block, done, total,
                      [&](std::size_t begin, std::size_t end, Poll poll) {
                          for (std::size_t i = begin; i < end; ++i) page.bake(pieces[i], poll);
                      });
        done += static_cast<double>(pieces.size());
    };
    bake_all(request.atlas.cells, 4);
    bake_all(request.tiles, 1);
    return page.finish();
}

}  // namespace faqem::detail
