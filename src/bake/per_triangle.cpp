#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bake/job.hpp"
#include "bake/page.hpp"
#include "bake/vertex_transfer.hpp"
#include "faqem/engine/vector.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;
using engine::Vector3;

// One group's faces and page.
struct GroupPage {
    Channels channels;
    std::vector<PageFace> faces;
    std::optional<Atlas> atlas;  // none where no image is needed
};

bool has_colors(const Part& part) {
    return std::any_of(part.colors.begin(), part.colors.end(), [](const Vec4f& c) {
        return c != Vec4f{1, 1, 1, 1};
    });
}

// An image is made where a material has one, and where factors differ.
Channels needed_channels(const Asset& asset, const MaterialGroup& group) {
    Channels result;
    const Material& first = group.material;
    for (Index m : group.materials) {
        const Material& material = material_or_default(asset, m);
        result.base = result.base || material.base_color_texture || material.base_color != first.base_color;
        if (first.unlit) continue;
        result.metallic_roughness = result.metallic_roughness || material.metallic_roughness_texture ||
                                    material.metallic != first.metallic ||
                                    material.roughness != first.roughness;
        result.occlusion = result.occlusion || material.occlusion_texture;
        result.emissive = result.emissive || material.emissive_texture || material.emissive != first.emissive;
    }
    return result;
}

std::vector<GroupPage> group_pages(const BakeJob& job, const MaterialGroups& groups) {
    std::vector<GroupPage> pages(groups.groups.size());
    for (std::size_t g = 0; g < pages.size(); ++g) {
        pages[g].channels = needed_channels(job.source, groups.groups[g]);
    }
    for (const SmallPart& part : job.parts) {
        const bool colors = has_colors(*part.source);
        const std::vector<Index>& kept = part.small->history.kept_faces;
        for (Index f = 0; f < part.faces(); ++f) {
            GroupPage& page = pages[groups.of(face_material(*part.source, kept[f]))];
            page.faces.push_back({part.index, f});
            page.channels.base = page.channels.base || colors;
        }
    }
    return pages;
}

// Source texels per length at a small face, root mean square over four places.
double density_at(const SmallPart& part, const SourceSurface& surface, Index face) {
    constexpr double third = 1.0 / 3, far = 2.0 / 3, near = 1.0 / 6;
    double sum = 0;
    for (const Vec3& w :
         {Vec3{third, third, third}, Vec3{far, near, near}, Vec3{near, far, near}, Vec3{near, near, far}}) {
        const double d = surface.texel_density(part.index, part.map->map(face, w).face);
        sum += d * d;
    }
    return std::sqrt(sum / 4);
}

std::array<Vector3, 3> corners_of(const TriangleMesh& mesh, Index face) {
    const Triangle& t = mesh.triangles[face];
    return {to_eigen(mesh.positions[t[0]]), to_eigen(mesh.positions[t[1]]), to_eigen(mesh.positions[t[2]])};
}

// Holds densities within a factor of 4 of their median by area, part by part: parts have their own units.
void clamp_densities(const BakeJob& job, std::span<const PageFace> faces, std::vector<double>& density) {
    for (std::size_t begin = 0, end; begin < faces.size(); begin = end) {
        struct Weighted {
            double density, area;
        };
        std::vector<Weighted> sorted;
        double total = 0;
        for (end = begin; end < faces.size() && faces[end].part == faces[begin].part; ++end) {
            const auto p = corners_of(job.parts[faces[end].part].small->mesh, faces[end].face);
            sorted.push_back({density[end], engine::area_vector(p[0], p[1], p[2]).norm()});
            total += sorted.back().area;
        }
        std::sort(sorted.begin(), sorted.end(), [](const Weighted& a, const Weighted& b) {
            return a.density != b.density ? a.density < b.density : a.area < b.area;
        });
        double sum = 0, median = 0;
        for (const Weighted& w : sorted) {
            median = w.density;
            if ((sum += w.area) >= total / 2) break;
        }
        for (std::size_t i = begin; i < end; ++i) density[i] = std::clamp(density[i], median / 4, median * 4);
    }
}

// 16 bits per axis.
std::uint64_t morton(const Vector3& unit) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto x = static_cast<std::uint64_t>(std::clamp(unit[axis], 0.0, 1.0) * 65535);
        for (int bit = 0; bit < 16; ++bit) code |= ((x >> bit) & 1) << (3 * bit + axis);
    }
    return code;
}

AtlasTriangle atlas_triangle(const std::array<Vector3, 3>& p, double density) {
    AtlasTriangle result;
    double longest = -1;
    for (std::uint8_t i = 0; i < 3; ++i) {  // the largest angle faces the longest edge
        const double length = (p[(i + 1) % 3] - p[(i + 2) % 3]).squaredNorm();
        if (length > longest) {
            longest = length;
            result.right = i;
        }
    }
    const Vector3& r = p[result.right];
    result.legs = {density * (p[(result.right + 1) % 3] - r).norm(),
                   density * (p[(result.right + 2) % 3] - r).norm()};
    return result;
}

std::optional<Atlas> make_atlas(const BakeJob& job, const SourceSurface& surface,
                                std::span<const PageFace> faces) {
    std::vector<double> density(faces.size());
    parallel_blocks(faces.size(), 256, job.options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            density[i] = density_at(job.parts[faces[i].part], surface, faces[i].face);
        }
    });
    clamp_densities(job, faces, density);
    std::vector<AtlasTriangle> triangles;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const TriangleMesh& mesh = job.parts[faces[i].part].small->mesh;
        triangles.push_back(atlas_triangle(corners_of(mesh, faces[i].face), density[i]));
    }
    for (const SmallPart& part : job.parts) {
        Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
        for (const Vec3& p : part.small->mesh.positions) {
            low = low.cwiseMin(to_eigen(p));
            high = high.cwiseMax(to_eigen(p));
        }
        const double size = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
        for (std::size_t i = 0; i < faces.size(); ++i) {
            if (faces[i].part != part.index) continue;
            const auto p = corners_of(part.small->mesh, faces[i].face);
            const Vector3 middle = (p[0] + p[1] + p[2]) / 3;
            triangles[i].order = (std::uint64_t{part.index & 0xffff} << 48) | morton((middle - low) / size);
        }
    }
    return pack_triangles(triangles, job.options.bake.texture_size);
}

TextureRef add_image(Asset& asset, const Pixels& pixels, const std::string& name) {
    TextureRef ref;
    ref.image = static_cast<Index>(asset.images.size());
    ref.wrap_u = ref.wrap_v = Wrap::clamp;
    asset.images.push_back(encode_png(pixels, name));
    return ref;
}

Material page_material(Asset& asset, const Material& first, const Channels& channels,
                       const PageImages& images) {
    Material result = first;
    result.rebaked = true;
    result.normal_texture = result.base_color_texture = result.metallic_roughness_texture =
        result.occlusion_texture = result.emissive_texture = {};
    result.normal_scale = result.occlusion_strength = 1;
    const std::string name =
        first.name.empty() ? "material" + std::to_string(asset.materials.size()) : first.name;
    if (channels.base) {
        result.base_color = {1, 1, 1, 1};
        result.base_color_texture = add_image(asset, images.base, name + "_baseColor");
    }
    if (channels.metallic_roughness || channels.occlusion) {
        const TextureRef orm =
            add_image(asset, images.occlusion_roughness_metallic, name + "_occlusionRoughnessMetallic");
        if (channels.occlusion) result.occlusion_texture = orm;
        if (channels.metallic_roughness) {
            result.metallic = result.roughness = 1;
            result.metallic_roughness_texture = orm;
        }
    }
    if (channels.emissive) {
        result.emissive = {1, 1, 1};
        result.emissive_texture = add_image(asset, images.emissive, name + "_emissive");
    }
    return result;
}

void warn_of_normal_maps(BakeJob& job, const MaterialGroups& groups) {
    for (const MaterialGroup& group : groups.groups) {
        for (Index m : group.materials) {
            if (!material_or_default(job.source, m).normal_texture) continue;
            job.warn(material_title(job.source, m) + ": the normal map is not baked anew and was left out");
        }
    }
}

// UVs of the corners of all parts, in 0..1.
std::vector<std::vector<Vec2f>> corner_uvs(const BakeJob& job, const std::vector<GroupPage>& pages) {
    std::vector<std::vector<Vec2f>> result(job.parts.size());
    for (const GroupPage& page : pages) {
        if (!page.atlas) continue;
        for (std::size_t i = 0; i < page.faces.size(); ++i) {
            const PageFace& face = page.faces[i];
            std::vector<Vec2f>& uvs = result[face.part];
            uvs.resize(3 * job.parts[face.part].faces(), Vec2f{0, 0});
            for (std::size_t c = 0; c < 3; ++c) {
                const auto& uv = page.atlas->places[i].uv[c];
                uvs[std::size_t{3} * face.face + c] = {static_cast<float>(uv[0] / page.atlas->width),
                                                       static_cast<float>(uv[1] / page.atlas->height)};
            }
        }
    }
    return result;
}

}  // namespace

bool bake_per_triangle(BakeJob& job) {
    const MaterialGroups groups = group_materials(job.source, Bake::per_triangle);
    std::vector<GroupPage> pages = group_pages(job, groups);
    Channels wanted;
    for (const GroupPage& page : pages) {
        wanted.base = wanted.base || page.channels.base;
        wanted.metallic_roughness = wanted.metallic_roughness || page.channels.metallic_roughness;
        wanted.occlusion = wanted.occlusion || page.channels.occlusion;
        wanted.emissive = wanted.emissive || page.channels.emissive;
    }
    const SourceSurface surface(job.source, wanted);
    double cells = 0;
    for (GroupPage& page : pages) {
        if (!page.channels.any() || page.faces.empty()) continue;
        page.atlas = make_atlas(job, surface, page.faces);
        if (!page.atlas) return false;
        cells += static_cast<double>(page.atlas->cells.size());
    }
    warn_of_normal_maps(job, groups);
    Asset& out = job.result.asset;
    double done = 0;
    for (std::size_t g = 0; g < pages.size(); ++g) {
        const GroupPage& page = pages[g];
        const Material& first = groups.groups[g].material;
        PageImages images;
        if (page.atlas) {
            images = bake_page(job, surface, {*page.atlas, page.faces, page.channels, first.alpha_mode}, done,
                               cells);
            done += static_cast<double>(page.atlas->cells.size());
        }
        out.materials.push_back(page_material(out, first, page.atlas ? page.channels : Channels{}, images));
    }
    std::vector<std::vector<Vec2f>> uvs = corner_uvs(job, pages);
    for (const SmallPart& part : job.parts) {
        CornerLayers layers{job.normals[part.index].normals, {}, {}};
        if (!uvs[part.index].empty()) layers.uvs.push_back(std::move(uvs[part.index]));
        JoinedPart joined = join_corners(part, layers);
        transfer_skin_and_morphs(part, joined);
        for (Index f : part.small->history.kept_faces) {
            joined.part.face_material.push_back(groups.of(face_material(*part.source, f)));
        }
        out.parts.push_back(std::move(joined.part));
    }
    return true;
}

}  // namespace faqem::detail
