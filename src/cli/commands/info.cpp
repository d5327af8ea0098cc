#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "asset/file_format.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/rounding_weld.hpp"
#include "cli/commands/commands.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/json.hpp"
#include "faqem/asset.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

struct PartInfo {
    std::string name;
    MeshInfo mesh;
    std::size_t materials = 0, uv_sets = 0, instances = 0;
    bool normals = false, colors = false, skinned = false;
};

struct ImageInfo {
    std::string name, mime_type;
    std::size_t bytes = 0;
    std::uint32_t width = 0, height = 0;
    std::string error;  ///< reason why the image cannot be decoded; empty if it can
};

struct AssetInfo {
    std::vector<PartInfo> parts;
    std::vector<ImageInfo> images;
    std::size_t materials = 0, instances = 0;
    const char* precision = "";  ///< of positions in the file
    MeshInfo scene;              ///< all instances in world space
    std::vector<std::string> warnings, not_understood;
};

MeshInfo info_of(const Part& part) { return info(MeshView{part.positions, part.triangles}); }

ImageInfo image_info(const Image& image) {
    ImageInfo result{image.name, image.mime_type, image.encoded.size(), 0, 0, {}};
    try {
        const Pixels pixels = decode(image);
        result.width = pixels.width;
        result.height = pixels.height;
    } catch (const Error& error) {
        result.error = error.what();
    }
    return result;
}

/// The totals of a scene that is too large to be flattened: counts of all instances, the box of their boxes, and areas
/// by the mean scale of each instance.
MeshInfo sum_of_instances(const Asset& asset, const std::vector<PartInfo>& parts,
                          const std::vector<Instance>& all) {
    MeshInfo sum;
    Eigen::AlignedBox3d box;
    for (const Instance& instance : all) {
        const MeshInfo& mesh = parts[instance.part].mesh;
        const Eigen::Affine3d transform(Eigen::Map<const Eigen::Matrix4d>(instance.transform.data()));
        sum.faces += mesh.faces;
        sum.degenerate_faces += mesh.degenerate_faces;
        sum.vertices += mesh.vertices;
        sum.components += mesh.components;
        sum.boundary_edges += mesh.boundary_edges;
        sum.nonmanifold_edges += mesh.nonmanifold_edges;
        sum.euler += mesh.euler;
        sum.area += mesh.area * std::pow(std::abs(transform.linear().determinant()), 2.0 / 3);
        if (asset.parts[instance.part].triangles.empty()) continue;
        const Eigen::AlignedBox3d own(engine::to_eigen(mesh.box_min), engine::to_eigen(mesh.box_max));
        box.extend(own.transformed(transform));
    }
    sum.box_min = engine::to_array(box.min());
    sum.box_max = engine::to_array(box.max());
    sum.diagonal = box.diagonal().norm();
    return sum;
}

AssetInfo examine(Asset asset) {
    AssetInfo result;
    result.warnings = asset.warnings;
    result.not_understood = asset.not_understood;
    for (std::string& warning : detail::weld_rounded_positions(asset))
        result.warnings.push_back(std::move(warning));
    const std::vector<Instance> scene_instances = instances(asset);
    std::vector<std::size_t> instances_of(asset.parts.size(), 0);
    for (const Instance& instance : scene_instances) ++instances_of[instance.part];
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        const Part& part = asset.parts[p];
        PartInfo one;
        one.name = part.name;
        one.mesh = info_of(part);
        std::set<Index> materials(part.face_material.begin(), part.face_material.end());
        materials.erase(no_index);
        one.materials = materials.size();
        one.uv_sets = part.uvs.size();
        one.normals = !part.normals.empty();
        one.colors = !part.colors.empty();
        one.skinned = !part.joints.empty();
        one.instances = instances_of[p];
        result.parts.push_back(std::move(one));
    }
    for (const Image& image : asset.images) result.images.push_back(image_info(image));
    constexpr std::array<const char*, 4> precisions = {"unknown", "float", "double", "decimal"};
    result.precision = precisions[static_cast<std::size_t>(asset.precision.type)];
    result.materials = asset.materials.size();
    result.instances = scene_instances.size();
    if (detail::has_excessive_instances(asset, scene_instances)) {
        result.scene = sum_of_instances(asset, result.parts, scene_instances);
        result.warnings.push_back("the scene shows " + detail::pluralized(result.scene.faces, "face") +
                                  ": its totals are sums over the instances");
    } else {
        result.scene = info_of(detail::flatten(asset));
    }
    return result;
}

Json as_json(const std::string& file, const AssetInfo& asset) {
    Json parts = Json::array(), images = Json::array();
    for (const PartInfo& part : asset.parts) {
        Json one = {{"name", part.name}};
        one.update(info_json(part.mesh));
        one.update({{"materials", part.materials},
                    {"uv_sets", part.uv_sets},
                    {"normals", part.normals},
                    {"vertex_colors", part.colors},
                    {"skinned", part.skinned},
                    {"instances", part.instances}});
        parts.push_back(std::move(one));
    }
    for (const ImageInfo& image : asset.images) {
        Json one = {{"name", image.name}, {"mime_type", image.mime_type}, {"bytes", image.bytes}};
        if (image.error.empty()) {
            one.update({{"width", image.width}, {"height", image.height}});
        } else {
            one["error"] = image.error;
        }
        images.push_back(std::move(one));
    }
    return {{"file", file},
            {"precision", asset.precision},
            {"parts", std::move(parts)},
            {"materials", asset.materials},
            {"images", std::move(images)},
            {"instances", asset.instances},
            {"total", info_json(asset.scene)},
            {"warnings", asset.warnings},
            {"not_understood", asset.not_understood}};
}

std::string point_text(const Vec3& p) {
    std::ostringstream out;
    out << "(" << p[0] << ", " << p[1] << ", " << p[2] << ")";
    return out.str();
}

void print_mesh(std::ostream& out, const MeshInfo& mesh) {
    using detail::pluralized;
    out << pluralized(mesh.faces, "face") << ", " << mesh.vertices << " vertices, "
        << pluralized(mesh.components, "component") << ", "
        << pluralized(mesh.boundary_edges, "boundary edge") << ", "
        << pluralized(mesh.nonmanifold_edges, "non-manifold edge");
    if (mesh.degenerate_faces > 0) out << ", " << pluralized(mesh.degenerate_faces, "degenerate face");
    out << "\n    box " << point_text(mesh.box_min) << " to " << point_text(mesh.box_max) << ", diagonal "
        << mesh.diagonal << ", area " << mesh.area << "\n";
}

void print_text(const std::string& file, const AssetInfo& asset) {
    using detail::pluralized;
    std::ostringstream out;
    out << file << " (positions: " << asset.precision << ")\n";
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        const PartInfo& part = asset.parts[p];
        out << "part " << p << (part.name.empty() ? "" : " '" + part.name + "'") << ": ";
        print_mesh(out, part.mesh);
        out << "    " << pluralized(part.materials, "material") << ", " << pluralized(part.uv_sets, "UV set")
            << (part.normals ? ", normals" : "") << (part.colors ? ", colours" : "")
            << (part.skinned ? ", skin" : "") << ", " << pluralized(part.instances, "instance") << "\n";
    }
    for (std::size_t i = 0; i < asset.images.size(); ++i) {
        const ImageInfo& image = asset.images[i];
        out << "image " << i << (image.name.empty() ? "" : " '" + image.name + "'") << ": " << image.mime_type
            << ", ";
        if (image.error.empty())
            out << image.width << " x " << image.height << ", " << image.bytes << " bytes\n";
        if (!image.error.empty()) out << image.error << "\n";
    }
    out << "scene (" << pluralized(asset.instances, "instance") << ", "
        << pluralized(asset.materials, "material") << "): ";
    print_mesh(out, asset.scene);
    for (const std::string& warning : asset.warnings) out << "warning: " << warning << "\n";
    for (const std::string& what : asset.not_understood) out << "not understood: " << what << "\n";
    std::cout << out.str();
}

}  // namespace

CommandInfo info_command() {
    struct InfoArguments {
        std::string file;
        bool json = false;
    };
    const auto arguments = std::make_shared<InfoArguments>();
    return {"info",
            "Count and measure the contents of a file",
            {"faqem info model.glb --json"},
            {positional("FILE", arguments->file, detail::listed_extensions(detail::FormatUse::read))},
            {flag_option("--json", arguments->json, "Print JSON instead of text")},
            [arguments] {
                install_signal_handlers();
                const ExitOnInterrupt exit_on_interrupt;
                const AssetInfo asset = examine(load(arguments->file));
                if (arguments->json) print_json(as_json(arguments->file, asset));
                if (!arguments->json) print_text(arguments->file, asset);
                return exit_ok;
            }};
}

}  // namespace faqem::cli
