#include "asset/formats/ply.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto read = [](fuzz::Bytes bytes, const std::string& file) {
        return detail::read_ply(bytes, file);
    };
    fuzz::read_sound({data, size}, read, "a.ply");
    return 0;
}
