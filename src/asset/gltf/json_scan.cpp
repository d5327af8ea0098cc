#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "asset/gltf/container.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/gltf/json.hpp"

namespace faqem::detail {
namespace {

// Upper estimates, measured with documents that have millions of such values. A value becomes an object in the source
// document and in the copy that is saved; elements of some arrays are also read.
constexpr double value_bytes = 130, string_bytes = 330, object_bytes = 300, member_bytes = 250;
constexpr double bytes_per_character = 4;
constexpr std::array<std::pair<std::string_view, double>, 3> element_bytes = {
    {{"materials", 2000}, {"meshes", 3000}, {"nodes", 1800}}};

/// Handles the events of the parser for a document, which therefore needs no memory: adds up the memory of its values,
/// and finds its URIs, also those of large, damaged and unsupported documents. The parser stops when a function returns
/// false, and at an error of the document.
class DocumentScan : public Json::json_sax_t {
public:
    /// \param allowed  bytes; the scan ends when there are more
    /// \param files    receives the URIs; null: they are not wanted
    DocumentScan(const std::filesystem::path& model, double allowed, ReferenceList* files)
        : allowed_(allowed), files_(files) {
        std::ifstream in;
        open_json(model, in);
        constexpr bool strict = false;  // other chunks may follow
        static_cast<void>(Json::sax_parse(in, this, Json::input_format_t::json, strict));
    }

    double bytes() const { return bytes_; }

    bool null() override { return add(value_bytes); }
    bool boolean(bool) override { return add(value_bytes); }
    bool number_integer(Json::number_integer_t) override { return add(value_bytes); }
    bool number_float(Json::number_float_t, const std::string&) override { return add(value_bytes); }
    bool number_unsigned(Json::number_unsigned_t) override { return add(value_bytes); }
    bool binary(Json::binary_t&) override { return true; }
    bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }
    bool key(std::string& name) override {
        key_ = name;
        if (depth_ == 1) top_key_ = name;
        return add_text(member_bytes, name);
    }
    bool string(std::string& value) override {
        if (files_ && is_uri_key() && !value.starts_with("data:")) add_reference(value);
        return add_text(string_bytes, value);
    }
    bool start_object(std::size_t) override {
        ++depth_;
        for (const auto& [array, bytes] : element_bytes)
            if (depth_ == 3 && top_key_ == array) return add(bytes);
        return add(object_bytes);
    }
    bool start_array(std::size_t) override {
        ++depth_;
        return add(object_bytes);
    }
    bool end_object() override { return end_array(); }
    bool end_array() override {
        --depth_;
        return true;
    }

private:
    /// Returns whether the total is still allowed.
    bool add(double bytes) {
        bytes_ += bytes;
        return bytes_ <= allowed_;
    }

    bool add_text(double bytes, const std::string& text) {
        return add(bytes + bytes_per_character * static_cast<double>(text.size()));
    }

    /// `uri`, and names that end with it, as schemaUri of EXT_structural_metadata.
    bool is_uri_key() const { return key_.ends_with("uri") || key_.ends_with("Uri"); }

    void add_reference(const std::string& uri) {
        const bool is_read = depth_ == 3 && (top_key_ == "buffers" || top_key_ == "images");
        files_->add(uri, ReferenceSyntax::uri, is_read ? Readable::yes : Readable::no);
        // load() takes the text after a ? or # as part of the name, other programs as a query or fragment.
        const std::size_t end = uri.find_first_of("?#");
        if (end != std::string::npos) files_->add(uri.substr(0, end), ReferenceSyntax::uri, Readable::no);
    }

    double allowed_, bytes_ = 0;
    ReferenceList* files_;
    // Number of objects and arrays around the current value; the document has depth 1.
    std::size_t depth_ = 0;
    std::string key_, top_key_;  // the last one; the last one of the document
};

}  // namespace

void list_gltf_references(const std::filesystem::path& model, ReferenceList& files) {
    DocumentScan(model, HUGE_VAL, &files);
}

std::uint64_t gltf_document_memory(const std::filesystem::path& model, std::uint64_t allowed) {
    const DocumentScan scan(model, static_cast<double>(allowed), nullptr);
    return static_cast<std::uint64_t>(scan.bytes());
}

}  // namespace faqem::detail
