#include <meshoptimizer.h>

#include "asset/gltf/read/compressed.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

std::vector<std::uint8_t> decode_meshopt(const Json& extension, std::span<const std::uint8_t> bytes,
                                         const std::string& file, const std::string& where) {
    const std::uint64_t count = unsigned_member(extension, "count", 0),
                        stride = unsigned_member(extension, "byteStride", 0);
    const std::string mode = string_member(extension, "mode"), filter = string_member(extension, "filter");
    std::vector<std::uint8_t> result(count * stride);
    int error = 0;
    if (mode == "ATTRIBUTES")
        error = meshopt_decodeVertexBuffer(result.data(), count, stride, bytes.data(), bytes.size());
    else if (mode == "TRIANGLES")
        error = meshopt_decodeIndexBuffer(result.data(), count, stride, bytes.data(), bytes.size());
    else
        error = meshopt_decodeIndexSequence(result.data(), count, stride, bytes.data(), bytes.size());
    if (error != 0) throw InputError(file, where, std::string(meshopt_name) + ": the data is damaged");
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(result.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(result.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(result.data(), count, stride);
    return result;
}

}  // namespace faqem::detail
