#pragma once
/// \file
/// The files of a model in memory, before they are written.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

namespace faqem::detail {

/// A file of a model.
struct EncodedFile {
    std::string name;                     ///< in the folder of the model
    std::span<const std::uint8_t> bytes;  ///< of `owner`
    std::shared_ptr<const void> owner;
    bool is_image = false;
};

/// A file with the bytes of a buffer, which are not copied.
/// \tparam Buffer  std::vector<std::uint8_t> or std::string
template <class Buffer>
EncodedFile encoded_file(std::string name, Buffer content) {
    const auto owner = std::make_shared<const Buffer>(std::move(content));
    return {std::move(name), {reinterpret_cast<const std::uint8_t*>(owner->data()), owner->size()}, owner};
}

/// A file with a copy of an image.
inline EncodedFile encoded_image(std::string name, const Image& image) {
    EncodedFile file = encoded_file(std::move(name), image.encoded);
    file.is_image = true;
    return file;
}

/// Whether a view of a result has values of animations.
inline bool is_animation(const ResultView& view) {
    return view.content.find("animation") != std::string::npos;
}

/// The files of a model, as save() writes them.
struct EncodedModel {
    std::vector<EncodedFile> files;   ///< a file that refers to others comes after them
    std::vector<std::string> losses;  ///< what the format cannot store, one sentence each
    std::vector<ResultView> views;    ///< of glTF: the buffer views in their order, without those of images
    std::uint64_t embedded_image_bytes = 0;  ///< of images in files that have other content, too

    /// Total size of all files. O(files)
    std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const EncodedFile& file : files) sum += file.bytes.size();
        return sum;
    }
    /// Size of the images, in files of their own or embedded. O(files)
    std::uint64_t image_bytes() const {
        std::uint64_t sum = embedded_image_bytes;
        for (const EncodedFile& file : files)
            if (file.is_image) sum += file.bytes.size();
        return sum;
    }
};

/// Writes the files of a model with write_files().
/// \param folder  of the model
/// \throws WriteError  a file cannot be written, or exists and must not be replaced
FAQEM_EXPORT void write_model(const EncodedModel& model, const std::filesystem::path& folder,
                              Overwrite overwrite);

}  // namespace faqem::detail
