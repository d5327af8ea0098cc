#include "cli/memory/gltf_memory.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "asset/gltf/json_scan.hpp"
#include "asset/io/file.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

constexpr double triangle_bytes = 24;          // corners and material, and the copy made while they grow
constexpr double growth_factor = 1.5;          // vertices of several primitives
constexpr double vertex_transient_bytes = 36;  // of the primitive that is being read
constexpr double index_transient_bytes = 12;
constexpr double image_copies = 2;
constexpr double decompression_factor = 3;  // result of Draco, and its own mesh

/// Components of an accessor type; 16 if it is unknown.
std::uint8_t component_count(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    return type == "VEC4" || type == "MAT2" ? 4 : 16;
}

constexpr std::uint64_t no_view = ~std::uint64_t{0};

struct AccessorSize {
    std::uint64_t count = 0, view = no_view;
    std::uint8_t components = 16;

    double max_bytes() const { return 4.0 * components * static_cast<double>(count); }
};

struct ViewSize {
    std::uint64_t bytes = 0;
    bool is_compressed = false;
};

/// First pass: memory of copies of images and of decompressed buffers, and the sizes of accessors.
class DocumentScan : public detail::JsonScan {
public:
    explicit DocumentScan(const fs::path& folder) : folder_(folder) {}

    std::vector<AccessorSize> accessors;

    /// Sets the counts and sizes to 0 that stored data cannot have: load() reports an error.
    /// \param stored_bytes  of all files of the model; every element takes at least one of them
    void remove_impossible_sizes(std::uint64_t stored_bytes) {
        for (ViewSize& view : views_)
            if (!view.is_compressed && view.bytes > stored_bytes) view.bytes = 0;
        for (AccessorSize& accessor : accessors) {
            const bool is_stored = accessor.view < views_.size() && !views_[accessor.view].is_compressed;
            if (is_stored && accessor.count > stored_bytes) accessor.count = 0;
        }
    }

    /// Total, bytes.
    double bytes() const {
        double total = repeated_file_bytes_;
        for (const std::uint64_t view : image_views_)
            if (view < views_.size()) total += image_copies * static_cast<double>(views_[view].bytes);
        for (const ViewSize& view : views_)
            if (view.is_compressed) total += static_cast<double>(view.bytes);
        for (const AccessorSize& accessor : accessors)
            if (accessor.view == no_view) total += decompression_factor * accessor.max_bytes();
        return total;
    }

protected:
    bool number(std::uint64_t value) override {
        if (depth() == 3 && key_at(1) == "accessors" && !accessors.empty()) {
            AccessorSize& accessor = accessors.back();
            if (key_at(3) == "count") accessor.count = value;
            if (key_at(3) == "bufferView") accessor.view = value;
        }
        if (depth() == 3 && key_at(1) == "bufferViews" && key_at(3) == "byteLength" && !views_.empty())
            views_.back().bytes = value;
        if (depth() == 3 && key_at(1) == "images" && key_at(3) == "bufferView") image_views_.push_back(value);
        return true;
    }

    bool on_string(const std::string& value) override {
        if (depth() == 3 && key_at(1) == "accessors" && key_at(3) == "type" && !accessors.empty())
            accessors.back().components = component_count(value);
        const bool is_file = depth() == 3 && key_at(3) == "uri" && !value.starts_with("data:");
        if (is_file && (key_at(1) == "images" || key_at(1) == "buffers")) add_file(value);
        return true;
    }

    bool on_start(bool /*is_object*/) override {
        if (depth() == 1 && key_at(1) == "accessors") accessors.clear();
        if (depth() == 1 && key_at(1) == "bufferViews") views_.clear();
        if (depth() == 1 && key_at(1) == "images") image_views_.clear();
        if (depth() == 2 && key_at(1) == "accessors") accessors.emplace_back();
        if (depth() == 2 && key_at(1) == "bufferViews") views_.emplace_back();
        if (depth() == 4 && key_at(1) == "bufferViews" && key_at(4) == "EXT_meshopt_compression" &&
            !views_.empty())
            views_.back().is_compressed = true;
        return true;
    }

private:
    /// The first use of a file is counted with its size.
    void add_file(const std::string& uri) {
        const auto [entry, is_new] = files_.try_emplace(uri, 0);
        if (is_new) {
            try {
                std::error_code error;
                const std::uintmax_t size = fs::file_size(detail::resolve_inside(folder_, uri), error);
                if (!error) entry->second = size;
            } catch (const Error&) {  // load() reports it
            }
        } else {
            repeated_file_bytes_ += image_copies * static_cast<double>(entry->second);
        }
    }

    fs::path folder_;
    double repeated_file_bytes_ = 0;
    std::vector<ViewSize> views_;
    std::vector<std::uint64_t> image_views_;
    std::map<std::string, std::uint64_t> files_;
};

/// Second pass: memory of the decoded meshes.
class MeshScan : public detail::JsonScan {
public:
    MeshScan(const std::vector<AccessorSize>& accessors, double allowed)
        : accessors_(accessors), allowed_(allowed) {}

    /// Total, bytes.
    double bytes() const { return mesh_bytes_ + transient_bytes_; }

protected:
    bool number(std::uint64_t value) override {
        if (key_at(1) != "meshes" || key_at(3) != "primitives") return true;
        if (depth() == 5 && key_at(5) == "mode") mode_ = value;
        if (depth() == 5 && key_at(5) == "indices") index_count_ = count_of(value);
        if (depth() == 6 && key_at(5) == "attributes") {
            names_.insert(key_at(6));
            vertices_key_ += key_at(6) + " " + std::to_string(value) + " ";
            if (key_at(6) == "POSITION") vertex_count_ = count_of(value);
        }
        if (depth() == 7 && key_at(5) == "targets") {
            vertices_key_ += std::to_string(targets_) + key_at(7) + " " + std::to_string(value) + " ";
            if (key_at(7) == "NORMAL") has_target_normals_ = true;
        }
        return true;
    }

    bool on_start(bool /*is_object*/) override {
        if (key_at(1) != "meshes") return true;
        if (depth() == 1) mesh_bytes_ = 0;
        if (depth() == 2) start_mesh();
        if (depth() == 4 && key_at(3) == "primitives") start_primitive();
        if (depth() == 6 && key_at(3) == "primitives" && key_at(5) == "targets") ++targets_;
        return mesh_bytes_ <= allowed_;
    }

    void on_end() override {
        if (key_at(1) != "meshes") return;
        if (depth() == 5 && key_at(3) == "primitives") end_primitive();
        if (depth() == 3) end_mesh();
    }

private:
    static constexpr std::uint64_t triangle_mode = 4, no_count = ~std::uint64_t{0};

    std::uint64_t count_of(std::uint64_t accessor) const {
        return accessor < accessors_.size() ? accessors_[accessor].count : 0;
    }

    void start_mesh() {
        names_.clear();
        known_vertices_.clear();
        vertices_ = triangles_ = 0;
        max_targets_ = 0;
        has_target_normals_ = false;
    }

    void start_primitive() {
        mode_ = triangle_mode;
        index_count_ = no_count;
        vertex_count_ = targets_ = 0;
        vertices_key_.clear();
    }

    /// Primitives with the same accessors share their vertices.
    void end_primitive() {
        if (mode_ < triangle_mode) return;
        const auto vertices = static_cast<double>(vertex_count_);
        const auto corners = index_count_ == no_count ? vertices : static_cast<double>(index_count_);
        if (known_vertices_.insert(vertices_key_).second) vertices_ += vertices;
        triangles_ += mode_ == triangle_mode ? corners / 3 : corners;
        max_targets_ = std::max(max_targets_, targets_);
        transient_bytes_ =
            std::max({transient_bytes_, vertex_transient_bytes * vertices, index_transient_bytes * corners});
    }

    /// Every vertex of a mesh has the attributes of all its primitives.
    void end_mesh() {
        double vertex_bytes = sizeof(Vec3);
        for (const std::string& name : names_) {
            if (name == "NORMAL") vertex_bytes += 12;
            if (name == "TANGENT" || name == "COLOR_0") vertex_bytes += 16;
            if (name.starts_with("TEXCOORD_")) vertex_bytes += 8;
            if (name == "JOINTS_0") vertex_bytes += 8;
            if (name == "WEIGHTS_0") vertex_bytes += 16;
        }
        vertex_bytes += static_cast<double>(max_targets_) * (has_target_normals_ ? 24 : 12);
        mesh_bytes_ += vertices_ * vertex_bytes * (known_vertices_.size() > 1 ? growth_factor : 1) +
                       triangles_ * triangle_bytes;
    }

    const std::vector<AccessorSize>& accessors_;
    double allowed_, mesh_bytes_ = 0, transient_bytes_ = 0;
    // The mesh that is being read.
    std::set<std::string> names_, known_vertices_;
    double vertices_ = 0, triangles_ = 0;
    std::uint64_t max_targets_ = 0;
    bool has_target_normals_ = false;
    // The primitive that is being read.
    std::uint64_t mode_ = triangle_mode, index_count_ = no_count, vertex_count_ = 0, targets_ = 0;
    std::string vertices_key_;
};

}  // namespace

std::uint64_t estimated_decoding_memory(const fs::path& model, std::uint64_t stored_bytes,
                                        std::uint64_t allowed) {
    const auto limit = static_cast<double>(allowed);
    DocumentScan document(model.parent_path());
    detail::scan_gltf(model, document);
    document.remove_impossible_sizes(stored_bytes);
    double bytes = document.bytes();
    if (bytes <= limit) {
        MeshScan meshes(document.accessors, limit - bytes);
        detail::scan_gltf(model, meshes);
        bytes += meshes.bytes();
    }
    return static_cast<std::uint64_t>(std::min(bytes, 1e19));
}

}  // namespace faqem::cli
