#include "asset/io/encoded_model.hpp"

#include "asset/io/file_set.hpp"

namespace faqem::detail {

std::uint64_t EncodedModel::bytes() const {
    std::uint64_t sum = 0;
    for (const EncodedFile& file : files) sum += file.bytes.size();
    return sum;
}

std::uint64_t EncodedModel::image_bytes() const {
    std::uint64_t sum = embedded_image_bytes;
    for (const EncodedFile& file : files)
        if (file.is_image) sum += file.bytes.size();
    return sum;
}

void write_model(const EncodedModel& model, const std::filesystem::path& folder, Overwrite overwrite) {
    std::vector<FileContent> contents;
    for (const EncodedFile& file : model.files) contents.push_back({folder / file.name, file.bytes});
    write_files(contents, overwrite);
}

}  // namespace faqem::detail
