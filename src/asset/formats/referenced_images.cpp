#include "asset/formats/referenced_images.hpp"

#include <utility>

#include "asset/image/image.hpp"
#include "asset/io/file.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

namespace fs = std::filesystem;

ReferencedImage* ReferencedImages::read(const std::string& owner, const std::string& reference,
                                        const fs::path& subfolder) {
    try {
        const FoundFile found = finder_.find(reference, subfolder);
        if (!found.is_as_named && reported_.insert(reference).second)
            asset_.warnings.push_back(owner + ": " + TextScanner::quoted(reference) +
                                      " was not found; the file " + TextScanner::quoted(found.name) +
                                      " is read");
        std::unique_ptr<ReferencedImage>& known = images_[found.file];
        if (known) return known.get();
        Image image{found.file.stem().string(), {}, read_file(found.file), found.name};
        const std::string reason = no_image_reason(image.encoded);
        if (!reason.empty()) throw InputError(found.name, "", reason);
        image.mime_type = sniff_mime_type(image.encoded);
        if (image.mime_type.empty() && lower_case_extension(found.file) == ".tga")
            image.mime_type = tga_media_type;
        known = std::make_unique<ReferencedImage>(ReferencedImage{std::move(image), no_index, {}});
        return known.get();
    } catch (const InputError& error) {
        asset_.warnings.push_back(owner + ": texture left out: " + error.what());
        return nullptr;
    }
}

Index ReferencedImages::use(ReferencedImage& image) {
    if (image.index == no_index) {
        image.index = static_cast<Index>(asset_.images.size());
        Image& from = image.image;
        asset_.images.push_back({from.name, from.mime_type, std::move(from.encoded), from.uri});
    }
    return image.index;
}

Pixels ReferencedImages::decode(const ReferencedImage& image) const {
    return faqem::decode(image.index == no_index ? image.image : asset_.images[image.index]);
}

Index ReferencedImages::derive(const std::string& key, const std::string& name,
                               const std::function<Pixels()>& make) {
    const auto known = derived_.find(key);
    if (known != derived_.end()) return known->second;
    const Pixels pixels = make();
    Index index = no_index;
    if (!pixels.rgba.empty()) {
        asset_.images.push_back(encode_png(pixels, name));
        index = static_cast<Index>(asset_.images.size() - 1);
    }
    derived_[key] = index;
    return index;
}

}  // namespace faqem::detail
