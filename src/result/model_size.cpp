#include "result/model_size.hpp"

#include <cstddef>
#include <string>

#include "asset/file_format.hpp"

namespace faqem::detail {

ModelSize model_size(const Asset& asset, ModelFormat format) {
    constexpr std::size_t name_length = 64;
    const std::string_view extension = result_format(format, format).extension;
    const EncodedModel model = encode_model(asset, std::string(name_length, 'm').append(extension));
    return {model.bytes() - model.image_bytes(), model.image_bytes()};
}

}  // namespace faqem::detail
