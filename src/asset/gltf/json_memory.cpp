#include <string>

#include "asset/gltf/gltf.hpp"
#include "asset/gltf/json_scan.hpp"

namespace faqem::detail {
namespace {

// Upper estimates, measured with documents that have millions of such values. A value becomes an object in the source
// document and in the copy that is saved; in meshes, materials, textures and samplers also in the document and the model
// of tinygltf.
constexpr double value_bytes = 320, string_bytes = 200, object_bytes = 1000, member_bytes = 300;
constexpr double bytes_per_character = 8;
constexpr double material_bytes = 5000, node_bytes = 1800;
// Extras are in the source document only, and in the copy that is saved.
constexpr double extra_value_bytes = 130, extra_object_bytes = 300, extra_member_bytes = 250;
constexpr double extra_bytes_per_character = 4;

/// Adds up the memory of all values.
class JsonMemoryScan : public JsonScan {
public:
    explicit JsonMemoryScan(double allowed) : allowed_(allowed) {}

    double bytes() const { return bytes_; }

protected:
    bool number(std::uint64_t /*value*/) override {
        return add(is_extra() ? extra_value_bytes : value_bytes);
    }

    bool on_key(const std::string& name) override {
        if (extras_depth_ == depth()) extras_depth_ = 0;
        if (extras_depth_ == 0 && name == "extras") extras_depth_ = depth();
        const auto size = static_cast<double>(name.size());
        return add(is_extra() ? extra_member_bytes + extra_bytes_per_character * size
                              : member_bytes + bytes_per_character * size);
    }

    bool on_string(const std::string& value) override {
        const auto size = static_cast<double>(value.size());
        return add(string_bytes + (is_extra() ? extra_value_bytes + extra_bytes_per_character * size
                                              : value_bytes + bytes_per_character * size));
    }

    bool on_start(bool is_object) override {
        if (is_extra()) return add(extra_object_bytes);
        if (depth() == 2 && key_at(1) == "materials") return add(material_bytes);
        if (depth() == 2 && key_at(1) == "nodes") return add(node_bytes);
        return add(is_object ? object_bytes : value_bytes);
    }

    void on_end() override {
        if (extras_depth_ == depth()) extras_depth_ = 0;
    }

private:
    bool is_extra() const { return extras_depth_ != 0; }

    /// Returns whether the total is still allowed.
    bool add(double bytes) {
        bytes_ += bytes;
        return bytes_ <= allowed_;
    }

    double allowed_, bytes_ = 0;
    std::size_t extras_depth_ = 0;  // depth of the object whose member `extras` is being read, or 0
};

}  // namespace

std::uint64_t gltf_document_memory(const std::filesystem::path& model, std::uint64_t allowed) {
    JsonMemoryScan scan(static_cast<double>(allowed));
    scan_gltf(model, scan);
    return static_cast<std::uint64_t>(scan.bytes());
}

}  // namespace faqem::detail
