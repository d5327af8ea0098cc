#include "asset/gltf/container.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>

#include "asset/io/number_type.hpp"
#include "asset/scene/messages.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint32_t glb_magic = 0x46546C67;   // glTF
constexpr std::uint32_t json_chunk = 0x4E4F534A;  // JSON
constexpr std::uint32_t bin_chunk = 0x004E4942;   // BIN
constexpr std::uint64_t glb_header_bytes = 12, chunk_header_bytes = 8;

/// Length of the GLB in its header, checked against the size of the file.
std::uint64_t checked_length(std::span<const std::uint8_t> bytes, const std::string& file,
                             std::vector<std::string>& warnings) {
    if (bytes.size() < glb_header_bytes)
        throw InputError(file, "GLB header", "needs 12 bytes, the file has " + std::to_string(bytes.size()));
    const std::uint32_t version = u32_at(bytes, 4);
    if (version != 2)
        throw UnsupportedError(file, "GLB header",
                               "version " + std::to_string(version) + " is not supported, only 2 is");
    const std::uint64_t length = u32_at(bytes, 8);
    if (length > bytes.size())
        throw InputError(
            file, "GLB header",
            "declares " + bytes_text(length) + ", the file has " + bytes_text(bytes.size()) + ": truncated");
    if (length < glb_header_bytes + chunk_header_bytes)
        throw InputError(file, "GLB header", "declares " + bytes_text(length) + ", too few for a JSON chunk");
    if (length < bytes.size())
        warnings.push_back(bytes_text(bytes.size() - length) + " after the end of the GLB were ignored");
    return length;
}

}  // namespace

GltfContainer split_gltf(std::span<const std::uint8_t> bytes, const std::string& file,
                         std::vector<std::string>& warnings) {
    GltfContainer container;
    if (bytes.size() < 4 || u32_at(bytes, 0) != glb_magic) {
        container.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
        return container;
    }
    container.is_binary = true;
    const std::uint64_t length = checked_length(bytes, file, warnings);
    std::uint64_t at = glb_header_bytes;
    for (std::uint64_t chunk = 0; at < length; ++chunk) {
        const std::string where = "GLB chunk " + std::to_string(chunk);
        if (length - at < chunk_header_bytes)
            throw InputError(file, where,
                             "needs a header of 8 bytes, " + bytes_text(length - at) + " are left");
        const std::uint64_t size = u32_at(bytes, at);
        const std::uint32_t type = u32_at(bytes, at + 4);
        at += chunk_header_bytes;
        if (size > length - at)
            throw InputError(file, where,
                             "needs " + bytes_text(size) + ", " + bytes_text(length - at) + " are left");
        if (chunk == 0 && type != json_chunk) throw InputError(file, where, "is not the JSON chunk");
        if (chunk == 0) {
            container.json = std::string_view(reinterpret_cast<const char*>(bytes.data() + at), size);
        } else if (chunk == 1 && type == bin_chunk) {
            container.bin = bytes.subspan(at, size);
            container.has_bin = true;
        } else {
            warnings.push_back(where + " has an unknown type and was ignored");
        }
        at += size;
    }
    return container;
}

std::uint64_t open_json(const std::filesystem::path& file, std::ifstream& in) {
    in.open(file, std::ios::binary);
    std::array<std::uint8_t, glb_header_bytes + chunk_header_bytes> head = {};
    in.read(reinterpret_cast<char*>(head.data()), head.size());
    const bool is_glb = in && u32_at(head, 0) == glb_magic;
    in.clear();
    if (!is_glb) in.seekg(0);
    std::error_code error;
    const std::uint64_t file_size = std::filesystem::file_size(file, error);
    if (error) return 0;
    return is_glb ? std::min<std::uint64_t>(u32_at(head, 12), file_size) : file_size;
}

std::string read_json_text(const std::filesystem::path& file) {
    std::ifstream in;
    const std::uint64_t size = open_json(file, in);
    if (size > std::numeric_limits<std::uint32_t>::max()) return {};
    std::string text(size, '\0');
    in.read(text.data(), static_cast<std::streamsize>(size));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

std::vector<std::uint8_t> join_glb(std::string_view json, std::span<const std::uint8_t> bin,
                                   const std::string& file) {
    const std::uint64_t json_size = (json.size() + 3) / 4 * 4;
    const std::uint64_t bin_size = (bin.size() + std::uint64_t{3}) / 4 * 4;
    const std::uint64_t total =
        glb_header_bytes + chunk_header_bytes + json_size + (bin.empty() ? 0 : chunk_header_bytes + bin_size);
    if (total > std::numeric_limits<std::uint32_t>::max())
        throw WriteError(file + ": a GLB of " + bytes_text(total) +
                         " exceeds the limit of 4 GiB; use .gltf instead");
    std::vector<std::uint8_t> out;
    out.reserve(total);
    put_number(out, glb_magic);
    put_number(out, std::uint32_t{2});
    put_number(out, static_cast<std::uint32_t>(total));
    const auto put_chunk = [&](std::uint32_t type, const auto& content, std::uint64_t size, char padding) {
        put_number(out, static_cast<std::uint32_t>(size));
        put_number(out, type);
        out.insert(out.end(), content.begin(), content.end());
        out.resize(out.size() + size - content.size(), static_cast<std::uint8_t>(padding));
    };
    put_chunk(json_chunk, json, json_size, ' ');
    if (!bin.empty()) put_chunk(bin_chunk, bin, bin_size, 0);
    return out;
}

}  // namespace faqem::detail
