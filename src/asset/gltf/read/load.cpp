#include "asset/gltf/read/load.hpp"

#include <limits>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/container.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/read/compressed.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/image/image.hpp"
#include "asset/io/file_finder.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_resource_bytes = std::uint64_t{1} << 34;

/// What the buffers and images of a document are read from.
struct FileContext {
    const Json& document;
    const GltfContainer& container;
    const fs::path& file;
    std::vector<std::string>& warnings;
    FileFinder finder{file.parent_path()};
};

bool is_data_uri(const std::string& uri) { return uri.starts_with("data:"); }

/// Decodes base64 (RFC 4648) up to the first other character, such as the padding.
std::vector<std::uint8_t> decode_base64(std::string_view text) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::size_t bits = 0;
    int count = 0;  // of bits that are no whole byte yet
    for (const char c : text) {
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos) break;
        bits = bits << 6 | digit;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> count));
    }
    return bytes;
}

/// Decodes a data URI of any media type: image types are detected from the bytes.
std::vector<std::uint8_t> decode_data_uri(std::string_view uri, const std::string& file,
                                          const std::string& where) {
    constexpr std::string_view marker = ";base64,";
    const std::size_t end = uri.find(marker);
    if (end == std::string_view::npos || end > uri.find(','))
        throw UnsupportedError(file, where, "data URIs that are not base64 are not supported");
    std::vector<std::uint8_t> bytes = decode_base64(uri.substr(end + marker.size()));
    if (bytes.empty()) throw InputError(file, where, "is not valid base64");
    return bytes;
}

/// Reads the file or data URI that a buffer or image refers to.
/// \throws ReadError   if the file does not exist or cannot be read
/// \throws InputError  if the reference is not allowed or the data URI is invalid
std::vector<std::uint8_t> read_uri(FileContext& context, const std::string& uri, const std::string& where,
                                   std::uint64_t max_bytes) {
    const std::string file = context.file.string();
    if (is_data_uri(uri)) return decode_data_uri(uri, file, where);
    if (file.empty()) throw InputError("", where, "a model in memory cannot refer to files");
    try {
        const FoundFile found = context.finder.find(uri, {}, ReferenceSyntax::uri);
        if (!found.is_as_named)
            context.warnings.push_back(where + ": " + TextScanner::quoted(uri) + " was not found; the file " +
                                       TextScanner::quoted(found.name) + " is read");
        return read_file(found.file, max_bytes);
    } catch (const ReadError& error) {
        throw ReadError(file, where, error.what());
    } catch (const InputError& error) {
        throw InputError(file, where, error.what());
    }
}

std::vector<std::uint8_t> load_buffer(FileContext& context, std::uint64_t index) {
    const Json& buffer = context.document["buffers"][index];
    if (is_fallback_buffer(buffer)) return {0};
    const std::string where = child_path("/buffers", index), file = context.file.string();
    const auto length = buffer["byteLength"].get<std::uint64_t>();
    const std::string uri = string_member(buffer, "uri");
    std::vector<std::uint8_t> bytes;
    if (!uri.empty()) {
        bytes = read_uri(context, uri, child_path(where, "uri"), max_resource_bytes);
    } else if (index == 0 && context.container.has_bin) {
        bytes.assign(context.container.bin.begin(), context.container.bin.end());
        if (bytes.size() > length && bytes.size() - length > 3)
            context.warnings.push_back(where + ": the BIN chunk has " +
                                       std::to_string(bytes.size() - length) +
                                       " bytes more than the buffer; they were ignored");
    } else {
        throw InputError(file, where,
                         context.container.is_binary ? "has neither a uri nor a BIN chunk" : "has no uri");
    }
    if (bytes.size() < length)
        throw InputError(
            file, where,
            "needs " + std::to_string(length) + " bytes, there are " + std::to_string(bytes.size()));
    bytes.resize(length);
    return bytes;
}

/// Reads an image from a file, a data URI or a buffer view; empty, with a warning, if there is none.
std::vector<std::uint8_t> load_image(FileContext& context, const SourceDocument& source,
                                     std::uint64_t index) {
    const Json& from = context.document["images"][index];
    const std::string where = child_path("/images", index), name = string_member(from, "name");
    try {
        std::vector<std::uint8_t> bytes;
        if (const Index view = index_member(from, "bufferView"); view == no_index) {
            bytes = read_uri(context, string_member(from, "uri"), child_path(where, "uri"), max_image_bytes);
        } else {
            const auto range = view_bytes(source, context.document["bufferViews"][view]);
            bytes.assign(range.begin(), range.end());
        }
        const std::string reason = no_image_reason(bytes);
        if (!reason.empty())
            throw ReadError("", name.empty() ? where : where + " (" + TextScanner::quoted(name) + ")",
                            reason);
        return bytes;
    } catch (const InputError& error) {
        context.warnings.push_back(std::string(error.what()) + "; the textures that use it were left out");
        return {};
    }
}

/// Reads the buffers and images of a document.
void load_resources(FileContext context, SourceDocument& source) {
    const Json& document = context.document;
    for (std::uint64_t i = 0; i < array_size(document, "buffers"); ++i)
        source.buffers.push_back(load_buffer(context, i));
    for (std::uint64_t i = 0; i < array_size(document, "images"); ++i) {
        const Json& from = document["images"][i];
        const Index view = index_member(from, "bufferView");
        Image& image = source.images.emplace_back();
        image.name = string_member(from, "name");
        image.uri = string_member(from, "uri");
        image.encoded = load_image(context, source, i);
        if (is_data_uri(image.uri)) image.uri.clear();
        image.mime_type = sniff_mime_type(image.encoded);
        if (image.mime_type.empty() && view != no_index) image.mime_type = string_member(from, "mimeType");
    }
}

/// Removes members that are null, except in extras: the checks take them for absent, and so must all that follows, which
/// may ask whether there is a member. The recursion is limited by max_json_depth.
void remove_null_members(Json& value) {
    if (value.is_array())
        for (Json& element : value) remove_null_members(element);
    if (!value.is_object()) return;
    std::erase_if(value.get_ref<Json::object_t&>(),
                  [](const auto& member) { return member.first != "extras" && member.second.is_null(); });
    for (auto& [key, member] : value.items())
        if (key != "extras") remove_null_members(member);
}

}  // namespace

Json parse_gltf(std::string_view json, const std::string& file) {
    if (json.size() > std::numeric_limits<unsigned>::max())
        throw UnsupportedError(file, "", "JSON of 4 GiB or more is not supported");
    const auto check_depth = [&](int depth, Json::parse_event_t event, const Json&) {
        const bool is_start =
            event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
        if (is_start && depth >= max_json_depth)
            throw InputError(file, "JSON",
                             "arrays and objects are nested deeper than " + std::to_string(max_json_depth));
        return true;
    };
    Json document;
    try {
        document = Json::parse(json.begin(), json.end(), check_depth);
    } catch (const Json::exception& error) {
        throw InputError(file, "JSON", error.what());
    }
    remove_null_members(document);
    const CheckedJson checked{document, file, document, ""};
    check_document(checked);
    check_accessors(checked);
    check_meshes_and_materials(checked);
    check_scene(checked);
    return document;
}

LoadedGltf load_gltf(std::span<const std::uint8_t> bytes, const fs::path& file) {
    LoadedGltf loaded;
    loaded.file = file.string();
    loaded.source = std::make_shared<SourceDocument>();
    const GltfContainer container = split_gltf(bytes, loaded.file, loaded.warnings);
    const Json& document = loaded.source->document = parse_gltf(container.json, loaded.file);
    load_resources({document, container, file, loaded.warnings}, *loaded.source);
    decompress(*loaded.source, loaded.file);
    check_sparse(*loaded.source, loaded.file);
    check_instances(*loaded.source, loaded.file);
    return loaded;
}

}  // namespace faqem::detail
