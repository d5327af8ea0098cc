#pragma once
/// \file
/// The table of the formats of model files. CONTRIBUTING.md tells how to add one.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/io/encoded_model.hpp"
#include "asset/io/file.hpp"
#include "asset/io/file_finder.hpp"
#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"

namespace faqem::detail {

struct LeveledAsset;

/// A file that save() writes beside a model, besides images.
struct SideFile {
    std::string (*name)(const std::string& stem) = nullptr;  ///< null: there is none
    bool is_always_written = false;
};

/// A format of model files. Functions that the format does not have are null.
struct FileFormat {
    std::string_view extension;                   ///< with its dot, in lower case
    ModelFormat format = ModelFormat::automatic;  ///< `automatic`: it is not written
    /// Whether a file is of the format, by its first bytes (64, or all it has) and the same without leading blanks.
    /// Null: the format has no signature.
    bool (*has_signature)(std::string_view head, std::string_view text) = nullptr;

    /// Reads the bytes of a file, and other files in its folder. The path is in messages, too.
    Asset (*read)(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) = nullptr;
    /// Encodes an asset. The file is the name of the model; it is in messages, and other files are named after it.
    EncodedModel (*encode)(const Asset& asset, const std::filesystem::path& file) = nullptr;
    /// Encodes the levels of detail of a scene as one file.
    EncodedModel (*encode_levels)(const LeveledAsset& levels, const std::filesystem::path& file) = nullptr;

    /// Adds the files that a model refers to. Null: it refers to none.
    void (*list_references)(const std::filesystem::path& model, ReferenceList& files) = nullptr;
    bool is_read_for_references = false;  ///< list_references() reads the whole file
    SideFile side_file = {};
    bool has_image_files = false;  ///< images are written to files beside the model

    bool is_gltf = false;
    /// Upper estimates, in bytes, of the memory that loading a model needs in addition to three times the bytes of its
    /// files: for its document, which may end when it exceeds what is allowed; and for what is decoded, which parses the
    /// document. Null: the sizes of the files tell enough.
    std::uint64_t (*document_memory)(const std::filesystem::path& model, std::uint64_t allowed) = nullptr;
    std::uint64_t (*decoding_memory)(const std::filesystem::path& model,
                                     std::uint64_t stored_bytes) = nullptr;
    double min_bytes_per_face = 0;  ///< of a file with more than 65,536 vertices, with half a vertex per face

    /// What Bake::automatic means for a source with appearance, and for one with neither materials nor colours.
    Bake bake = Bake::automatic, bare_bake = Bake::automatic;
    bool holds_normals = true;
    /// Parts without materials can be stored as they are, and materials of glTF only as baked images.
    bool keeps_plain_parts = false;
};

/// What can be done with a format.
enum class FormatUse { read, write, write_levels, write_textures };

/// Returns the format of an output file, by its name. \throws UnsupportedError  it cannot be written
FAQEM_EXPORT const FileFormat& written_format(const std::filesystem::path& file);

/// Encodes a model as save() writes it. \param file  its name, whose extension determines the format
/// \throws UnsupportedError  the format cannot be written
/// \throws WriteError        the format cannot hold the asset
/// Complexity: O(size of the asset).
inline EncodedModel encode_model(const Asset& asset, const std::filesystem::path& file) {
    return written_format(file).encode(asset, file);
}

/// All formats. The first one is the default of the command.
FAQEM_EXPORT std::span<const FileFormat> file_formats();

/// Returns the format by the extension of the name in any case, which determines the format of an output file; null if
/// it is unknown. Lives as long as the program.
inline const FileFormat* format_by_name(const std::filesystem::path& file) {
    const std::string extension = lower_case_extension(file);
    for (const FileFormat& format : file_formats())
        if (format.extension == extension) return &format;
    return nullptr;
}

/// Checks that a file does not begin like one of another kind: HTML, XML, a Git LFS pointer, an archive, an image or a PDF;
/// and, with a name of glTF, like neither a GLB nor JSON.
/// \param file  a regular file; one that cannot be read passes
/// \throws InputError        it is empty, or has the name of a model and begins otherwise
/// \throws UnsupportedError  it has no name of a model and begins like another kind
void check_beginning(const std::filesystem::path& file);

/// Returns the format of an existing file: by its first bytes, or by its name if these have no signature; null if both
/// are unknown.
/// \param file  a regular file; one that cannot be read has the format of its name
FAQEM_EXPORT const FileFormat* format_of_file(const std::filesystem::path& file);

/// Returns the format that a result is made for. Lives as long as the program.
/// \param wanted  Options::format
/// \param loaded  Asset::format of the source
FAQEM_EXPORT const FileFormat& result_format(ModelFormat wanted, ModelFormat loaded);

/// Returns the extensions of the formats with a use, in the order of the table, with their dots.
FAQEM_EXPORT std::vector<std::string_view> format_extensions(FormatUse use);

/// Returns the extensions as text: `.glb, .gltf or .obj`.
/// \param conjunction  before the last one
FAQEM_EXPORT std::string listed_extensions(FormatUse use, std::string_view conjunction = "or");

}  // namespace faqem::detail
