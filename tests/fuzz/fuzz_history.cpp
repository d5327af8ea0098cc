#include <sstream>

#include "faqem/history.hpp"
#include "faqem/surface_map.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;

namespace {

std::string text_of(const CollapseHistory& history) {
    std::ostringstream out;
    write(history, out);
    return out.str();
}

/// Any history that is accepted can be replayed and asked where a point of the small mesh was.
void use(const CollapseHistory& history) {
    const TriangleMesh small = replay(history);
    for (const Triangle& t : small.triangles)
        for (const Index v : t) fuzz::expect(v < small.positions.size(), "a replayed mesh in range");
    for (const Mapping mapping : {Mapping::projection, Mapping::lineage}) {
        const SurfaceMap map(history, mapping);
        for (Index f = 0; f < std::min<std::size_t>(small.triangles.size(), 8); ++f) {
            const SurfacePoint at = map.map(f, {0.25, 0.25, 0.5});
            fuzz::expect(at.face < history.triangles.size(), "a point on a face of the original");
            fuzz::expect(fuzz::is_finite(at.barycentric), "finite barycentrics");
            const SurfacePoint next = map.map_near(f, {0.5, 0.25, 0.25}, at);
            fuzz::expect(next.face < history.triangles.size(), "a nearby point on a face of the original");
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    const auto history = fuzz::refusable("history", [&] { return read_history(in); });
    if (!history) return 0;
    const std::string text = text_of(*history);
    std::istringstream again(text);
    fuzz::expect(text_of(read_history(again)) == text, "what was written reads back the same");
    use(*history);
    return 0;
}
