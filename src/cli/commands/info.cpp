#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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
#include "scene/material_groups.hpp"

namespace faqem::cli {

namespace {

MeshInfo info_of(const Part& part) { return info(MeshView{part.positions, part.triangles}); }

Json image_json(const Image& image) {
    Json one = {{"name", image.name}, {"mime_type", image.mime_type}, {"bytes", image.encoded.size()}};
    try {
        const Pixels pixels = decode(image);
        one.update({{"width", pixels.width}, {"height", pixels.height}});
    } catch (const Error& error) {
        one["error"] = error.what();
    }
    return one;
}

/// The totals of a scene that is too large to be flattened: counts of all instances, the box of their boxes, and areas
/// by the mean scale of each instance.
/// \param meshes  by part
MeshInfo sum_of_instances(const Asset& asset, const std::vector<MeshInfo>& meshes,
                          const std::vector<Instance>& all) {
    MeshInfo sum;
    Eigen::AlignedBox3d box;
    for (const Instance& instance : all) {
        const MeshInfo& mesh = meshes[instance.part];
        const Eigen::Affine3d transform(Eigen::Map<const Eigen::Matrix4d>(instance.transform.data()));
        for (const auto count :
             {&MeshInfo::faces, &MeshInfo::degenerate_faces, &MeshInfo::vertices, &MeshInfo::components,
              &MeshInfo::boundary_edges, &MeshInfo::nonmanifold_edges})
            sum.*count += mesh.*count;
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

/// What --json prints.
Json examine(const std::string& file, Asset asset) {
    std::vector<std::string> warnings = asset.warnings;
    for (std::string& warning : detail::weld_rounded_positions(asset)) warnings.push_back(std::move(warning));
    const std::vector<Instance> scene_instances = instances(asset);
    std::vector<std::size_t> instances_of(asset.parts.size(), 0);
    for (const Instance& instance : scene_instances) ++instances_of[instance.part];
    std::vector<MeshInfo> meshes;
    Json parts = Json::array(), images = Json::array();
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        const Part& part = asset.parts[p];
        Json one = {{"name", part.name}};
        one.update(info_json(meshes.emplace_back(info_of(part))));
        one.update({{"materials", detail::materials_of(part).size()},
                    {"uv_sets", part.uvs.size()},
                    {"normals", !part.normals.empty()},
                    {"vertex_colors", !part.colors.empty()},
                    {"skinned", !part.joints.empty()},
                    {"instances", instances_of[p]}});
        parts.push_back(std::move(one));
    }
    for (const Image& image : asset.images) images.push_back(image_json(image));
    MeshInfo total;  // all instances in world space
    if (detail::has_excessive_instances(asset, scene_instances)) {
        total = sum_of_instances(asset, meshes, scene_instances);
        warnings.push_back("the scene shows " + detail::pluralized(total.faces, "face") +
                           ": its totals are sums over the instances");
    } else {
        total = info_of(detail::flatten(asset));
    }
    constexpr std::array<const char*, 4> precisions = {"unknown", "float", "double", "decimal"};
    return {{"file", file},
            {"precision", precisions[static_cast<std::size_t>(asset.precision.type)]},
            {"parts", std::move(parts)},
            {"materials", asset.materials.size()},
            {"images", std::move(images)},
            {"instances", scene_instances.size()},
            {"total", info_json(total)},
            {"warnings", warnings},
            {"not_understood", asset.not_understood}};
}

std::string point_text(const Json& point) {
    std::ostringstream out;
    const auto p = point.get<Vec3>();
    out << "(" << p[0] << ", " << p[1] << ", " << p[2] << ")";
    return out.str();
}

/// "part 0 'wheel': "
std::string title_of(const char* kind, std::size_t number, const Json& one) {
    const auto name = one["name"].get<std::string>();
    return std::string(kind) + " " + std::to_string(number) + (name.empty() ? "" : " '" + name + "'") + ": ";
}

std::string counted(const Json& count, const char* what) {
    return detail::pluralized(count.get<std::uint64_t>(), what);
}

void print_mesh(std::ostream& out, const Json& mesh) {
    out << counted(mesh["faces"], "face") << ", " << mesh["vertices"] << " vertices, "
        << counted(mesh["components"], "component") << ", "
        << counted(mesh["boundary_edges"], "boundary edge") << ", "
        << counted(mesh["nonmanifold_edges"], "non-manifold edge");
    if (mesh["degenerate_faces"] > 0) out << ", " << counted(mesh["degenerate_faces"], "degenerate face");
    out << "\n    box " << point_text(mesh["box_min"]) << " to " << point_text(mesh["box_max"])
        << ", diagonal " << mesh["diagonal"].get<double>() << ", area " << mesh["area"].get<double>() << "\n";
}

/// \param asset  of examine()
std::string text_of(const Json& asset) {
    std::ostringstream out;
    out << asset["file"].get<std::string>() << " (positions: " << asset["precision"].get<std::string>()
        << ")\n";
    for (std::size_t p = 0; p < asset["parts"].size(); ++p) {
        const Json& part = asset["parts"][p];
        out << title_of("part", p, part);
        print_mesh(out, part);
        out << "    " << counted(part["materials"], "material") << ", " << counted(part["uv_sets"], "UV set")
            << (part["normals"] ? ", normals" : "") << (part["vertex_colors"] ? ", colours" : "")
            << (part["skinned"] ? ", skin" : "") << ", " << counted(part["instances"], "instance") << "\n";
    }
    for (std::size_t i = 0; i < asset["images"].size(); ++i) {
        const Json& image = asset["images"][i];
        out << title_of("image", i, image) << image["mime_type"].get<std::string>() << ", ";
        if (image.contains("error"))
            out << image["error"].get<std::string>() << "\n";
        else
            out << image["width"] << " x " << image["height"] << ", " << image["bytes"] << " bytes\n";
    }
    out << "scene (" << counted(asset["instances"], "instance") << ", "
        << counted(asset["materials"], "material") << "): ";
    print_mesh(out, asset["total"]);
    for (const auto& [key, prefix] :
         {std::pair("warnings", "warning: "), {"not_understood", "not understood: "}})
        for (const Json& text : asset[key]) out << prefix << text.get<std::string>() << "\n";
    return out.str();
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
                const Json asset = examine(arguments->file, load(arguments->file));
                std::cout << (arguments->json ? json_text(asset) : text_of(asset));
                return exit_ok;
            }};
}

}  // namespace faqem::cli
