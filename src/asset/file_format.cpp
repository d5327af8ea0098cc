#include "asset/file_format.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include "asset/formats/formats.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/gltf/write/levels.hpp"
#include "asset/image/image.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

bool is_glb(std::string_view head, std::string_view /*text*/) { return head.starts_with("glTF"); }
bool is_json(std::string_view /*head*/, std::string_view text) { return text.starts_with('{'); }

constexpr FileFormat glb = {.extension = ".glb",
                            .format = ModelFormat::glb,
                            .has_signature = is_glb,
                            .read = read_gltf,
                            .encode = encode_gltf,
                            .encode_levels = encode_gltf_levels,
                            .list_references = list_gltf_references,
                            .is_gltf = true,
                            .document_memory = gltf_document_memory,
                            .decoding_memory = gltf_decoding_memory,
                            .min_bytes_per_face = 15};

constexpr FileFormat gltf = [] {
    FileFormat format = glb;
    format.extension = ".gltf";
    format.format = ModelFormat::gltf;
    format.has_signature = is_json;
    format.side_file = {.name = buffer_file_name, .is_always_written = true};
    format.has_image_files = true;
    return format;
}();

// A GLB with the extension VRM or VRMC_vrm.
constexpr FileFormat vrm = [] {
    FileFormat format = glb;
    format.extension = ".vrm";
    format.has_signature = nullptr;
    return format;
}();

constexpr auto formats = std::to_array<FileFormat>({
    glb,
    gltf,
    vrm,
#ifndef __EMSCRIPTEN__  // where models are GLB in memory: the other formats would be a tenth of the code
    {.extension = ".obj",
     .format = ModelFormat::obj,
     .read = read_obj,
     .encode = encode_obj,
     .list_references = list_obj_references,
     .is_read_for_references = true,
     .side_file = {.name = library_file_name},
     .has_image_files = true,
     .min_bytes_per_face = 28,
     .bare_bake = Bake::none,
     .keeps_plain_parts = true},
    {.extension = ".ply",
     .format = ModelFormat::ply,
     .has_signature =
         [](std::string_view head, std::string_view /*text*/) {
             return head.starts_with("ply\n") || head.starts_with("ply\r");
         },
     .read = read_ply,
     .encode = encode_ply,
     .list_references = list_ply_references,
     .min_bytes_per_face = 15,
     .bake = Bake::vertex,
     .bare_bake = Bake::none,
     .keeps_plain_parts = true},
    {.extension = ".stl",
     .format = ModelFormat::stl,
     .read = read_stl,
     .encode = encode_stl,
     .min_bytes_per_face = 50,
     .bake = Bake::none,
     .bare_bake = Bake::none,
     .holds_normals = false},
    {.extension = ".off",
     .has_signature = [](std::string_view /*head*/,
                         std::string_view text) { return text.starts_with("OFF"); },
     .read = read_off,
     .min_bytes_per_face = 28},
#endif
});

/// How to get a file that is read of one that is not, by its extension.
constexpr std::array<std::pair<std::string_view, const char*>, 5> convertible_formats = {{
    {".blend", "open it in Blender and export glTF 2.0 (.glb)"},
    {".dae", "import it into Blender and export glTF 2.0 (.glb)"},
    {".fbx", "import it into Blender and export glTF 2.0 (.glb)"},
    {".usdz", "import it into Blender and export glTF 2.0 (.glb)"},
    {".3mf", "export it as .stl or .obj from a CAD program or slicer"},
}};

/// The first bytes of a file and the same without leading blanks; none if it cannot be read.
struct Beginning {
    explicit Beginning(const fs::path& file) {
        std::ifstream in(file, std::ios::binary);
        in.read(bytes.data(), bytes.size());
        head = {bytes.data(), static_cast<std::size_t>(in.gcount())};
        text = head.substr(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
    }
    std::array<char, 64> bytes = {};
    std::string_view head, text;
};

bool has_use(const FileFormat& format, FormatUse use) {
    return use == FormatUse::read             ? format.read != nullptr
           : use == FormatUse::write          ? format.encode != nullptr
           : use == FormatUse::write_textures ? format.is_gltf || format.has_image_files
                                              : format.encode_levels != nullptr;
}

}  // namespace

std::span<const FileFormat> file_formats() { return formats; }

void check_beginning(const fs::path& file) {
    const Beginning beginning(file);
    std::error_code error;
    if (fs::file_size(file, error) == 0 && !error) throw InputError(file.string(), "", "is empty");
    const bool has_mark = beginning.head.starts_with("\xef\xbb\xbf");
    const std::string_view text = has_mark ? beginning.head.substr(3) : beginning.text;
    const char* const kind = foreign_kind(text);
    const FileFormat* format = format_of_file(file);
    for (const auto& [extension, how] : convertible_formats)
        if (!format && lower_case_extension(file) == extension &&
            !text.starts_with("version https://git-lfs"))
            throw UnsupportedError(file.string(), "", "is not read: " + std::string(how));
    std::string begins;
    if (kind)
        begins = std::string("like ") + kind;
    else if (format && format->is_gltf && !text.starts_with('{') && !text.starts_with("glTF"))
        begins = "with " + TextScanner::quoted(text.substr(0, text.find_first_of("\r\n")));
    if (begins.empty()) return;
    if (!format) throw UnsupportedError(file.string(), "", "is not a model file: it begins " + begins);
    std::string name(format->extension.substr(1));
    for (char& c : name) c = static_cast<char>(c - 'a' + 'A');
    const char* article = name[0] == 'O' || name[0] == 'S' ? "an " : "a ";
    throw InputError(file.string(), "", "is not " + (article + name) + " file: it begins " + begins);
}

const FileFormat* format_of_file(const fs::path& file) {
    const auto& [bytes, head, text] = Beginning(file);
    for (const FileFormat& format : formats)
        if (format.has_signature && format.has_signature(head, text)) return &format;
    return format_by_name(file);
}

const FileFormat& written_format(const fs::path& file) {
    const FileFormat* format = format_by_name(file);
    if (format && format->encode) return *format;
    throw UnsupportedError(
        file.string(), "",
        "cannot be written: the file name must end in " + listed_extensions(FormatUse::write));
}

const FileFormat& result_format(ModelFormat wanted, ModelFormat loaded) {
    const ModelFormat known = wanted == ModelFormat::automatic ? loaded : wanted;
    const auto found = std::ranges::find(formats, known, &FileFormat::format);
    return known == ModelFormat::automatic || found == formats.end() ? formats.front() : *found;
}

std::vector<std::string_view> format_extensions(FormatUse use) {
    std::vector<std::string_view> found;
    for (const FileFormat& format : formats)
        if (has_use(format, use)) found.push_back(format.extension);
    return found;
}

std::string listed_extensions(FormatUse use, std::string_view conjunction) {
    const std::vector<std::string_view> all = format_extensions(use);
    const std::string last = std::string(" ").append(conjunction).append(" ");
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) text += i + 1 < all.size() ? ", " : last;
        text += all[i];
    }
    return text;
}

}  // namespace faqem::detail
