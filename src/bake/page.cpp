#include "bake/page.hpp"

#include <cmath>

#include "bake/fill.hpp"
#include "faqem/engine/vector.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;

// Below this a texel's colour is that of texels around it.
constexpr float clear = 1.0f / 512;

Pixels blank(const Atlas& atlas, bool wanted, bool has_alpha) {
    if (!wanted) return {};
    const std::size_t texels = std::size_t{atlas.width} * atlas.height;
    return {atlas.width, atlas.height, std::vector<std::uint8_t>(4 * texels, 255), has_alpha};
}

// Sums of samples.
struct Texel {
    Linear base{};
    std::array<float, 3> orm{};
    Vec3f emissive{};

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
        images_.base = blank(atlas, channels.base, request.alpha_mode != AlphaMode::opaque);
        images_.occlusion_roughness_metallic =
            blank(atlas, channels.occlusion || channels.metallic_roughness, false);
        images_.emissive = blank(atlas, channels.emissive, false);
        known_.assign(std::size_t{atlas.width} * atlas.height, 0);
        if (images_.base.has_alpha) opaque_.assign(known_.size(), 0);
    }

    void bake(const AtlasCell& cell) {
        Painter first(*this, cell.first);
        if (cell.second == no_index) {
            bake_rows(cell, [&](double, double) -> Painter& { return first; });
            return;
        }
        // The two face each other with their hypotenuses and have the same legs: the weights of their right
        // corners tell which one is nearer.
        Painter second(*this, cell.second);
        bake_rows(cell, [&](double x, double y) -> Painter& {
            return second.frame.at(x, y)[second.right] > first.frame.at(x, y)[first.right] ? second : first;
        });
    }

    PageImages finish() {
        if (request_.channels.base) {
            const bool alpha = images_.base.has_alpha;
            push_pull(images_.base, alpha ? opaque_ : known_, {0, 3});
            if (alpha) push_pull(images_.base, known_, {3, 4});
        }
        if (!images_.occlusion_roughness_metallic.rgba.empty()) {
            push_pull(images_.occlusion_roughness_metallic, known_, {0, 3});
        }
        if (request_.channels.emissive) push_pull(images_.emissive, known_, {0, 3});
        return std::move(images_);
    }

private:
    // A triangle and where its last sample was.
    struct Painter {
        Painter(const Page& page, Index triangle)
            : face(page.request_.faces[triangle]),
              place(page.request_.atlas.places[triangle]),
              frame(place),
              right(right_corner(place)),
              map(*page.job_.parts[face.part].map),
              spacing(texel_length(page.job_.parts[face.part].small->mesh) / page.samples_) {}

        // The right corner is the one whose UV is level with one other corner and plumb with the other.
        static std::size_t right_corner(const AtlasPlace& place) {
            for (std::size_t i = 0; i < 3; ++i) {
                const auto &r = place.uv[i], &a = place.uv[(i + 1) % 3], &b = place.uv[(i + 2) % 3];
                if ((r[0] == a[0] && r[1] == b[1]) || (r[1] == a[1] && r[0] == b[0])) return i;
            }
            return 0;
        }

        // Length of a texel on the small surface, the longer one of its sides.
        double texel_length(const TriangleMesh& mesh) const {
            const Triangle& t = mesh.triangles[face.face];
            const auto corner = [&](std::size_t i) { return to_eigen(mesh.positions[t[i % 3]]); };
            if (single()) return std::sqrt(engine::area_vector(corner(0), corner(1), corner(2)).norm() / 2);
            return std::max((corner(right + 1) - corner(right)).norm() / place.legs[0],
                            (corner(right + 2) - corner(right)).norm() / place.legs[1]);
        }

        bool single() const { return place.legs[0] == 0; }

        // The point of the triangle for place (s, t) of texel (x, y).
        Vec3 point(std::uint32_t x, std::uint32_t y, double s, double t) const {
            if (!single()) return frame.closest(x + s, y + t);
            return s + t > 1 ? Vec3{s + t - 1, 1 - s, 1 - t} : Vec3{1 - s - t, s, t};
        }

        const PageFace face;
        const AtlasPlace& place;
        const AtlasFrame frame;
        const std::size_t right;
        const SurfaceMap& map;
        const double spacing;
        SurfacePoint last;
        bool started = false;  // `last` is in this row
    };

    template <class Choose>
    void bake_rows(const AtlasCell& cell, Choose&& choose) {
        for (std::uint32_t y = cell.y; y < cell.y + cell.height; ++y) {
            Painter* previous = nullptr;
            for (std::uint32_t x = cell.x; x < cell.x + cell.width; ++x) {
                Painter& painter = choose(x + 0.5, y + 0.5);
                painter.started = painter.started && previous == &painter;
                previous = &painter;
                write(x, y, sampled(painter, x, y));
            }
        }
    }

    Texel sampled(Painter& painter, std::uint32_t x, std::uint32_t y) const {
        const float share = 1.0f / static_cast<float>(samples_ * samples_);
        Texel sum;
        for (std::uint32_t j = 0; j < samples_; ++j) {
            for (std::uint32_t i = 0; i < samples_; ++i) {
                const Vec3 w = painter.point(x, y, (i + 0.5) / samples_, (j + 0.5) / samples_);
                const Index face = painter.face.face;
                painter.last =
                    painter.started ? painter.map.map_near(face, w, painter.last) : painter.map.map(face, w);
                painter.started = true;
                sum.add(surface_.sample(painter.face.part, painter.last, painter.spacing), share);
            }
        }
        return sum;
    }

    void write(std::uint32_t x, std::uint32_t y, const Texel& texel) {
        const std::size_t at = std::size_t{y} * request_.atlas.width + x;
        known_[at] = 1;
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
    }

    const BakeJob& job_;
    const SourceSurface& surface_;
    const PageRequest& request_;
    std::uint32_t samples_;
    PageImages images_;
    std::vector<std::uint8_t> known_;   // texels in cells
    std::vector<std::uint8_t> opaque_;  // those with a colour
};

}  // namespace

PageImages bake_page(const BakeJob& job, const SourceSurface& surface, const PageRequest& request,
                     double done, double total) {
    Page page(job, surface, request);
    const std::vector<AtlasCell>& cells = request.atlas.cells;
    polled_blocks(job, Phase::bake, cells.size(), 4, done, total, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) page.bake(cells[c]);
    });
    return page.finish();
}

}  // namespace faqem::detail
