#pragma once
/// \file
/// The image files that a model of a format other than glTF refers to, and images that are made of them.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "asset/io/file_finder.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// An image file of a model.
struct ReferencedImage {
    Image image;                        ///< without bytes once it is in the asset
    Index index = no_index;             ///< index into Asset::images, if it is there
    std::optional<bool> is_normal_map;  ///< if it was examined
};

/// Reads the image files of a model, each once. Problems are warnings of the asset.
class ReferencedImages {
public:
    /// \param asset   receives images and warnings; must outlive this
    /// \param finder  must outlive this
    ReferencedImages(Asset& asset, FileFinder& finder) : asset_(asset), finder_(finder) {}

    /// Reads the file that a reference means. Null if it is missing or outside the folder.
    /// \param owner      what refers to it, for warnings
    /// \param reference  as written
    /// \param subfolder  of the file with the reference, relative to the folder of the model
    ReferencedImage* read(const std::string& owner, const std::string& reference,
                          const std::filesystem::path& subfolder);

    /// Adds an image to the asset if it is not there yet, and returns its index.
    Index use(ReferencedImage& image);

    /// Decodes an image.
    /// \throws InputError  as decode()
    Pixels decode(const ReferencedImage& image) const;

    /// Adds an image that is made of others, and returns its index.
    /// \param key   of the image: it is made once
    /// \param name  Image::name
    /// \param make  returns the pixels, or none if there is no image to add
    /// \return no_index if there is no image
    /// \throws InputError  what `make` throws
    Index derive(const std::string& key, const std::string& name, const std::function<Pixels()>& make);

private:
    Asset& asset_;
    FileFinder& finder_;
    std::map<std::filesystem::path, std::unique_ptr<ReferencedImage>> images_;
    std::map<std::string, Index> derived_;
    std::set<std::string> reported_;  // references that were reported to be found elsewhere
};

}  // namespace faqem::detail
