#include "asset/io/encoded_model.hpp"

#include "asset/io/file_set.hpp"

namespace faqem::detail {

void write_model(const EncodedModel& model, const std::filesystem::path& folder, Overwrite overwrite) {
    std::vector<FileContent> contents;
    for (const EncodedFile& file : model.files) contents.push_back({folder / file.name, file.bytes});
    write_files(contents, overwrite);
}

}  // namespace faqem::detail
