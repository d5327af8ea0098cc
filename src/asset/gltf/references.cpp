#include <string>

#include "asset/gltf/gltf.hpp"
#include "asset/gltf/json_scan.hpp"
#include "asset/io/reference_list.hpp"

namespace faqem::detail {
namespace {

/// Finds the URIs of a glTF document, also of large, damaged and unsupported ones.
class UriScan : public JsonScan {
public:
    explicit UriScan(ReferenceList& files) : files_(files) {}

protected:
    bool on_key(const std::string& name) override {
        key_ = name;
        return true;
    }

    bool on_string(const std::string& value) override {
        if (!is_uri_key() || value.starts_with("data:")) return true;
        const bool is_read = depth() == 3 && (key_at(1) == "buffers" || key_at(1) == "images");
        files_.add(value, ReferenceSyntax::uri, is_read ? Readable::yes : Readable::no);
        // load() takes the text after a ? or # as part of the name, other programs as a query or fragment.
        const std::size_t end = value.find_first_of("?#");
        if (end != std::string::npos) files_.add(value.substr(0, end), ReferenceSyntax::uri, Readable::no);
        return true;
    }

private:
    /// `uri`, and names that end with it, as schemaUri of EXT_structural_metadata.
    bool is_uri_key() const { return key_.ends_with("uri") || key_.ends_with("Uri"); }

    ReferenceList& files_;
    std::string key_;  // the last one
};

}  // namespace

void list_gltf_references(const std::filesystem::path& model, ReferenceList& files) {
    UriScan scan(files);
    scan_gltf(model, scan);
}

}  // namespace faqem::detail
