#include <ostream>

#include "faqem/bake.hpp"
#include "faqem/detail/history/binary_io.hpp"

namespace faqem {
namespace {

constexpr char magic[8] = {'F', 'A', 'Q', 'E', 'M', 'C', '0', '1'};

// Layout of one texel in the file.
struct Record {
    std::uint32_t part, face;
    float second, third;  // barycentric weights of these corners; that of the first is 1 minus both
    std::uint32_t step;
};
static_assert(sizeof(Record) == 20);

using detail::put;

Record record(const TexelOrigin& texel) {
    if (texel.part == no_index) return {no_index, no_index, 0, 0, 0};
    return {texel.part, texel.point.face, static_cast<float>(texel.point.barycentric[1]),
            static_cast<float>(texel.point.barycentric[2]), static_cast<std::uint32_t>(texel.point.step)};
}

}  // namespace

void write(const std::vector<PageOrigins>& pages, std::ostream& out) {
    put(out, magic);
    put(out, static_cast<std::uint32_t>(pages.size()));
    for (const PageOrigins& page : pages) {
        put(out, page.material);
        put(out, page.width);
        put(out, page.height);
        std::vector<Record> row;
        for (std::size_t begin = 0; begin < page.texels.size(); begin += page.width) {
            row.clear();
            for (std::size_t x = 0; x < page.width; ++x) row.push_back(record(page.texels[begin + x]));
            out.write(reinterpret_cast<const char*>(row.data()),
                      static_cast<std::streamsize>(row.size() * sizeof(Record)));
        }
    }
}

}  // namespace faqem
