#include "asset/gltf/read/load.hpp"

#include <charconv>
#include <exception>
#include <limits>
#include <string_view>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/container.hpp"
#include "asset/gltf/instancing.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/read/compressed.hpp"
#include "asset/image/image.hpp"
#include "asset/io/file.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_resource_bytes = std::uint64_t{1} << 34;
constexpr std::string_view buffer_token = "faqem-buffer-";
constexpr std::string_view image_token = "faqem-image-";

/// Data of the tinygltf callbacks.
struct CallbackContext {
    const Json& document;
    const GltfContainer& container;
    fs::path file;
    std::vector<std::string>& warnings;
};

bool is_data_uri(const std::string& uri) { return uri.compare(0, 5, "data:") == 0; }

std::vector<std::uint8_t> decode_data_uri(const std::string& uri, const std::string& file,
                                          const std::string& where) {
    // The media type is replaced, since tinygltf supports only some; image types are detected from the bytes.
    constexpr std::string_view marker = ";base64,";
    const std::size_t end = uri.find(marker);
    if (end == std::string::npos || end > uri.find(','))
        throw UnsupportedError(file, where, "data URIs that are not base64 are not supported");
    std::vector<std::uint8_t> bytes;
    std::string media_type;
    const std::string known = "data:application/octet-stream;base64," + uri.substr(end + marker.size());
    if (!tinygltf::DecodeDataURI(&bytes, media_type, known, 0, false))
        throw InputError(file, where, "is not valid base64");
    return bytes;
}

/// Reads the file or data URI that a buffer or image refers to.
/// \throws ReadError   if the file does not exist or cannot be read
/// \throws InputError  if the reference is not allowed or the data URI is invalid
std::vector<std::uint8_t> read_uri(const CallbackContext& context, const std::string& uri,
                                   const std::string& where, std::uint64_t max_bytes) {
    const std::string file = context.file.string();
    if (is_data_uri(uri)) return decode_data_uri(uri, file, where);
    try {
        return read_file(resolve_inside(context.file.parent_path(), uri), max_bytes);
    } catch (const ReadError& error) {
        throw ReadError(file, where, error.what());
    } catch (const InputError& error) {
        throw InputError(file, where, error.what());
    }
}

std::vector<std::uint8_t> load_buffer(const CallbackContext& context, std::uint64_t index) {
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

/// Reads an image file. A missing image becomes a single zero byte, since tinygltf rejects empty images.
std::vector<std::uint8_t> load_image(const CallbackContext& context, std::uint64_t index) {
    const std::string where = child_path("/images", index);
    try {
        std::vector<std::uint8_t> bytes =
            read_uri(context, string_member(context.document["images"][index], "uri"),
                     child_path(where, "uri"), max_image_bytes);
        if (bytes.empty()) throw ReadError("", where, "is empty");
        return bytes;
    } catch (const ReadError& error) {
        context.warnings.push_back(std::string(error.what()) + "; the textures that use it were left out");
        return {0};
    }
}

bool token_exists(const std::string& name, void*) {
    return name.compare(0, buffer_token.size(), buffer_token) == 0 ||
           name.compare(0, image_token.size(), image_token) == 0;
}

std::string keep_path(const std::string& name, void*) { return name; }

bool read_token(std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
    const auto& context = *static_cast<const CallbackContext*>(user);
    const bool is_buffer = name.compare(0, buffer_token.size(), buffer_token) == 0;
    std::uint64_t index = 0;
    const char* digits = name.data() + (is_buffer ? buffer_token : image_token).size();
    std::from_chars(digits, name.data() + name.size(), index);
    *out = is_buffer ? load_buffer(context, index) : load_image(context, index);
    return true;
}

/// Sizes are limited where bytes are read, so tinygltf's own limit is not used.
[[maybe_unused]] bool token_size(std::size_t* size, std::string*, const std::string&, void*) {
    *size = 0;
    return true;
}

bool refuse_write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

bool store_image(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    image->image.assign(bytes, bytes + size);
    return true;
}

/// A copy without extras, which the tinygltf model would expand to 152 bytes per number and nothing reads there.
/// The recursion is limited by check_json_depth().
Json without_extras(const Json& from) {
    if (from.is_array()) {
        Json copy = Json::array();
        copy.get_ref<Json::array_t&>().reserve(from.size());
        for (const Json& element : from) copy.push_back(without_extras(element));
        return copy;
    }
    if (!from.is_object()) return from;
    Json copy = Json::object();
    for (const auto& [key, value] : from.items())
        if (key != "extras" || !value.is_structured()) copy[key] = without_extras(value);
    return copy;
}

/// The document without extras, with every URI replaced by a token for the callbacks. Buffers without data get
/// one byte, and accessors with Draco data get a view, since tinygltf requires both.
std::string json_with_uri_tokens(const Json& document) {
    Json copy = without_extras(document);
    for (std::uint64_t i = 0; i < array_size(copy, "buffers"); ++i) {
        if (is_fallback_buffer(copy["buffers"][i])) copy["buffers"][i]["byteLength"] = 1;
        copy["buffers"][i]["uri"] = std::string(buffer_token) + std::to_string(i);
    }
    const std::vector<char> draco = draco_accessor_flags(document);
    for (std::uint64_t i = 0; i < draco.size(); ++i)
        if (draco[i] && !copy["accessors"][i].contains("bufferView")) copy["accessors"][i]["bufferView"] = 0;
    for (std::uint64_t i = 0; i < array_size(copy, "images"); ++i)
        if (copy["images"][i].contains("uri"))
            copy["images"][i]["uri"] = std::string(image_token) + std::to_string(i);
    return copy.dump();
}

/// A template, because the callback GetFileSizeInBytes exists from tinygltf 2.9 on only.
template <class Callbacks>
Callbacks token_callbacks(CallbackContext& context) {
    Callbacks callbacks{};
    callbacks.FileExists = token_exists;
    callbacks.ExpandFilePath = keep_path;
    callbacks.ReadWholeFile = read_token;
    callbacks.WriteWholeFile = refuse_write;
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) callbacks.GetFileSizeInBytes = token_size;
    callbacks.user_data = &context;
    return callbacks;
}

tinygltf::Model parse_with_tinygltf(const Json& document, CallbackContext& context) {
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(token_callbacks<tinygltf::FsCallbacks>(context));
    parser.SetImageLoader(store_image, nullptr);
    const std::string file = context.file.string(), json = json_with_uri_tokens(document);
    if (json.size() > std::numeric_limits<unsigned>::max())
        throw UnsupportedError(file, "", "JSON of 4 GiB or more is not supported");
    tinygltf::Model model;
    std::string errors, warnings;
    try {
        if (!parser.LoadASCIIFromString(&model, &errors, &warnings, json.data(),
                                        static_cast<unsigned>(json.size()), "", tinygltf::NO_REQUIRE))
            throw InputError(file, "", errors.substr(0, errors.find('\n')));
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(file, "", error.what());
    }
    return model;
}

/// Moves the buffers and images from the tinygltf model to the source document.
void move_buffers_and_images(LoadedGltf& loaded) {
    for (tinygltf::Buffer& buffer : loaded.model.buffers)
        loaded.source->buffers.push_back(std::move(buffer.data));
    for (tinygltf::Image& from : loaded.model.images) {
        Image image;
        image.name = from.name;
        const std::uint64_t index = loaded.source->images.size();
        const std::string uri = string_member(loaded.source->document["images"][index], "uri");
        if (!is_data_uri(uri)) image.uri = uri;
        if (from.image.size() > 1) {
            image.encoded = std::move(from.image);
            image.mime_type = sniff_mime_type(image.encoded);
            if (image.mime_type.empty()) image.mime_type = from.mimeType;
        }
        loaded.source->images.push_back(std::move(image));
    }
    loaded.model.buffers.clear();
    loaded.model.images.clear();
}

/// Removes members that are null, except in extras: the checks take them for absent, and so must all that follows, which
/// may ask whether there is a member. The recursion is limited by check_json_depth().
void remove_null_members(Json& value) {
    if (value.is_array())
        for (Json& element : value) remove_null_members(element);
    if (!value.is_object()) return;
    for (auto member = value.begin(); member != value.end();) {
        if (member.key() != "extras" && member->is_null()) {
            member = value.erase(member);
            continue;
        }
        if (member.key() != "extras") remove_null_members(*member);
        ++member;
    }
}

}  // namespace

Json parse_gltf(std::string_view json, const std::string& file) {
    check_json_depth(json, file);
    Json document;
    try {
        document = Json::parse(json.begin(), json.end());
    } catch (const Json::exception& error) {
        throw InputError(file, "JSON", error.what());
    }
    remove_null_members(document);
    validate_gltf(document, file);
    return document;
}

LoadedGltf load_gltf(std::span<const std::uint8_t> bytes, const fs::path& file) {
    LoadedGltf loaded;
    loaded.file = file.string();
    loaded.source = std::make_shared<SourceDocument>();
    const GltfContainer container = split_gltf(bytes, loaded.file, loaded.warnings);
    const Json& document = loaded.source->document = parse_gltf(container.json, loaded.file);
    CallbackContext context{document, container, file, loaded.warnings};
    loaded.model = parse_with_tinygltf(document, context);
    move_buffers_and_images(loaded);
    decompress(*loaded.source, loaded.file);
    check_sparse(*loaded.source, loaded.file);
    check_instances(*loaded.source, loaded.file);
    return loaded;
}

}  // namespace faqem::detail
