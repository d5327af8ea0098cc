#include "asset/image/image.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "asset/image/codecs.hpp"
#include "asset/image/image_size.hpp"
#include "faqem/detail/base/lower_case.hpp"
#include "faqem/error.hpp"

namespace faqem {
namespace detail {
namespace {

struct FileSignature {
    std::string_view magic;
    std::size_t magic_offset;
    const char* mime_type;
    const char* extension;
};

constexpr std::array<FileSignature, 10> file_signatures = {
    {{{"\x89PNG\r\n\x1a\n", 8}, 0, "image/png", ".png"},
     {{"\xff\xd8\xff", 3}, 0, "image/jpeg", ".jpg"},
     {{"WEBP", 4}, 8, "image/webp", ".webp"},
     {{"\xabKTX 20\xbb", 8}, 0, ktx2_media_type, ".ktx2"},
     {{"ftypavif", 8}, 4, "image/avif", ".avif"},
     {{"DDS ", 4}, 0, "image/vnd-ms.dds", ".dds"},
     {{"GIF8", 4}, 0, "image/gif", ".gif"},
     {{"II*\0", 4}, 0, "image/tiff", ".tif"},
     {{"MM\0*", 4}, 0, "image/tiff", ".tif"},
     {{"BM", 2}, 0, "image/bmp", ".bmp"}}};

/// Beginnings of files that are found under the names of models and images, in lower case, and what they are.
constexpr std::array<std::pair<std::string_view, const char*>, 9> foreign_kinds = {{
    {"<!doctype", "an HTML page"},
    {"<html", "an HTML page"},
    {"<?xml", "an XML file"},
    {"version https://git-lfs.github.com", "a Git LFS pointer; 'git lfs pull' fetches the file itself"},
    {"pk\3\4", "a ZIP archive; unpack it first"},
    {"\x1f\x8b", "a gzip archive; unpack it first"},
    {"\x89png\r\n", "a PNG image"},
    {"\xff\xd8\xff", "a JPEG image"},
    {"%pdf-", "a PDF document"},
}};

/// OpenImageIO's name of the format of an image that the plugin decodes; empty for others.
std::string plugin_format(const Image& image) {
    const std::string type = media_type(image);
    if (type == tga_media_type) return "targa";
    if (type == "image/bmp" || type == "image/gif" || type == "image/tiff") return type.substr(6);
    return "";
}

/// Checks the size in the header before a decoder is called: decoders allocate memory according to the
/// header, some of them as soon as they open an image.
void check_header(const Image& image) {
    const std::optional<ImageSize> size = declared_size(image);
    if (!size) fail_image(image, "is damaged: its header has no image size");
    check_image_size(image, *size);
    if (!is_plausible_size(image, *size)) fail_truncated_image(image, *size);
}

}  // namespace

#ifndef FAQEM_WITH_KTX2
bool reads_ktx2() { return false; }
#endif

std::string sniff_mime_type(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const FileSignature& kind : file_signatures)
        if (text.size() >= kind.magic_offset &&
            text.substr(kind.magic_offset, kind.magic.size()) == kind.magic)
            return kind.mime_type;
    return "";
}

const char* foreign_kind(std::string_view text) {
    const std::string begin = lower_case(std::string(text.substr(0, 64)));
    const auto kind =
        std::ranges::find_if(foreign_kinds, [&](const auto& k) { return begin.starts_with(k.first); });
    return kind == foreign_kinds.end() ? nullptr : kind->second;
}

std::string no_image_reason(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return "is empty";
    if (!sniff_mime_type(bytes).empty()) return "";
    if (bytes.size() < 16) return "is no image: it has fewer than 16 bytes";
    const char* const kind = foreign_kind({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return kind ? std::string("is no image: it begins like ") + kind : "";
}

std::string media_type(const Image& image) {
    const std::string type = sniff_mime_type(image.encoded);
    const bool is_tga = image.mime_type == tga_media_type || image.mime_type == "image/tga";
    return type.empty() && is_tga ? tga_media_type : type;
}

bool needs_plugin(const Image& image) { return !plugin_format(image).empty(); }

bool is_passed_through(const Image& image) {
    return !image.encoded.empty() && !needs_plugin(image) && !can_decode_image(media_type(image));
}

bool keeps_encoding(const Image& image) {
    return is_passed_through(image) || media_type(image) == ktx2_media_type;
}

bool can_decode_image(const std::string& mime_type) {
    return mime_type == "image/png" || mime_type == "image/jpeg" || mime_type == "image/webp" ||
           (mime_type == ktx2_media_type && reads_ktx2());
}

std::string file_extension(const std::string& mime_type) {
    for (const FileSignature& kind : file_signatures)
        if (mime_type == kind.mime_type) return kind.extension;
    return mime_type == tga_media_type ? ".tga" : ".bin";
}

}  // namespace detail

Pixels decode(const Image& image) {
    const std::string type = detail::media_type(image);
    const std::string format = detail::plugin_format(image);
    if (format.empty() && !detail::can_decode_image(type))
        throw UnsupportedError(
            image.uri, detail::image_title(image),
            (type.empty() ? std::string("has an unknown format") : type + " is not supported") +
                "; only PNG, JPEG, WebP, TGA, BMP, TIFF and GIF are supported");
    detail::check_header(image);
#ifdef FAQEM_WITHOUT_IMAGE_PLUGIN
    if (!format.empty())
        throw UnsupportedError(
            image.uri, detail::image_title(image),
            type + " needs a build of faqem with OpenImageIO; this one reads PNG, JPEG and WebP");
#else
    if (!format.empty()) return detail::image_plugin().decode(image, format);
#endif
#ifdef FAQEM_WITH_KTX2
    if (type == detail::ktx2_media_type) return detail::ktx2_plugin().decode(image, "ktx2");
#endif
    if (type == "image/png") return detail::read_png(image);
    if (type == "image/jpeg") return detail::read_jpeg(image);
    return detail::read_webp(image);
}

Image encode_png(const Pixels& pixels, const std::string& name) {
    detail::check_pixel_count(pixels, name);
    return detail::write_png(pixels, name);
}

}  // namespace faqem
