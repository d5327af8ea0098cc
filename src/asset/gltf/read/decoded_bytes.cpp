#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/container.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/gltf/read/compressed.hpp"
#include "asset/gltf/read/load.hpp"
#include "asset/io/file_finder.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

constexpr double triangle_bytes = 24;          // corners and material, and the copy made while they grow
constexpr double growth_factor = 1.5;          // vertices of several primitives
constexpr double vertex_transient_bytes = 48;  // of the attribute that is being read
constexpr double index_transient_bytes = 12;
constexpr double file_copies = 2;
constexpr double decompression_factor = 3;  // result of Draco, and its own mesh

/// Bytes per vertex of the array that an attribute is read to, at most.
double bytes_per_vertex(std::string_view attribute) {
    if (attribute == "POSITION") return sizeof(Vec3);
    if (attribute.starts_with('_')) return sizeof(std::array<double, 4>);
    if (attribute == "NORMAL") return sizeof(Vec3f);
    return attribute.starts_with("TEXCOORD_") || attribute.starts_with("JOINTS_") ? 8 : sizeof(Vec4f);
}

/// Size of a file that a document refers to; 0 if it cannot be read, which load() reports.
double referenced_bytes(FileFinder& finder, const std::string& uri) {
    try {
        return static_cast<double>(fs::file_size(finder.find(uri, {}, ReferenceSyntax::uri).file));
    } catch (const Error&) {
    } catch (const fs::filesystem_error&) {
    }
    return 0;
}

/// Memory of the files that are read more than once; the first use is counted with the sizes of all files.
double repeated_file_bytes(const Json& document, const fs::path& folder) {
    double total = 0;
    FileFinder finder(folder);
    std::map<std::string, double> files;
    for (const char* const key : {"buffers", "images"}) {
        for (const Json& object : member(document, key)) {
            const std::string uri = string_member(object, "uri");
            if (uri.empty() || uri.starts_with("data:")) continue;
            const auto [entry, is_new] = files.try_emplace(uri, 0);
            if (is_new) entry->second = referenced_bytes(finder, uri);
            if (!is_new) total += file_copies * entry->second;
        }
    }
    return total;
}

double count_of(const Json& document, const Json& accessor) {
    return static_cast<double>(unsigned_member(document["accessors"][accessor.get<Index>()], "count", 0));
}

/// Memory of all meshes, and of the largest arrays that are needed while one is read.
double mesh_bytes(const Json& document) {
    double total = 0, transient = 0;
    for (const Json& mesh : member(document, "meshes")) {
        // Primitives with the same accessors share their vertices. Every vertex has the attributes of all primitives.
        std::set<std::string> names, known_vertices;
        double vertices = 0, triangles = 0, target_bytes = sizeof(Vec3f);
        std::uint64_t targets = 0;
        for (const Json& primitive : member(mesh, "primitives")) {
            if (!has_triangles(primitive)) continue;
            const Json& attributes = primitive["attributes"];
            const double own = count_of(document, attributes["POSITION"]);
            const double corners =
                primitive.contains("indices") ? count_of(document, primitive["indices"]) : own;
            const Json& own_targets = member(primitive, "targets");
            if (known_vertices.insert(attributes.dump() + own_targets.dump()).second) vertices += own;
            triangles += primitive_mode(primitive) == triangle_list ? corners / 3 : corners;
            transient = std::max({transient, vertex_transient_bytes * own, index_transient_bytes * corners});
            for (const auto& [name, accessor] : attributes.items()) names.insert(name);
            targets = std::max<std::uint64_t>(targets, own_targets.size());
            for (const Json& target : own_targets)
                if (target.contains("NORMAL")) target_bytes = 2 * sizeof(Vec3f);
        }
        double vertex_bytes = static_cast<double>(targets) * target_bytes;
        for (const std::string& name : names) vertex_bytes += bytes_per_vertex(name);
        total += vertices * vertex_bytes * (known_vertices.size() > 1 ? growth_factor : 1) +
                 triangles * triangle_bytes;
    }
    return total + transient;
}

/// \param document  validated
double decoded_bytes(const Json& document, const fs::path& folder, std::uint64_t stored_bytes) {
    double total = repeated_file_bytes(document, folder);
    for (const Json& buffer : member(document, "buffers"))
        if (!is_fallback_buffer(buffer) && unsigned_member(buffer, "byteLength", 0) > stored_bytes)
            return total;  // load() reports it before anything is decoded
    const auto view_bytes = [&](const Json& view) {
        return static_cast<double>(unsigned_member(view, "byteLength", 0));
    };
    for (const Json& image : member(document, "images"))
        if (const Index view = index_member(image, "bufferView"); view != no_index)
            total += file_copies * view_bytes(document["bufferViews"][view]);
    for (const Json& view : member(document, "bufferViews"))
        if (!meshopt_extension(document, view).is_null()) total += view_bytes(view);
    for (const Json& accessor : member(document, "accessors"))
        if (!accessor.contains("bufferView"))
            total += decompression_factor * 4.0 * component_count(string_member(accessor, "type")) *
                     static_cast<double>(unsigned_member(accessor, "count", 0));
    return total + mesh_bytes(document);
}

}  // namespace

std::uint64_t gltf_decoding_memory(const fs::path& model, std::uint64_t stored_bytes) {
    try {
        const Json document = parse_gltf(read_json_text(model), model.string());
        const double bytes = decoded_bytes(document, model.parent_path(), stored_bytes);
        return static_cast<std::uint64_t>(std::min(bytes, 1e19));
    } catch (const Error&) {
        return 0;
    }
}

}  // namespace faqem::detail
