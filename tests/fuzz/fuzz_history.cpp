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

/// Replays a valid history, and maps points of the simplified mesh to the original.
void use(const CollapseHistory& history) {
    const TriangleMesh simplified = replay(history);
    for (const Triangle& t : simplified.triangles)
        for (const Index v : t)
            fuzz::expect(v < simplified.positions.size(), "a replayed mesh with indices in range");
    const SurfaceMap map(history);
    for (Index f = 0; f < std::min<std::size_t>(simplified.triangles.size(), 8); ++f) {
        const SurfacePoint at = map.map(f, {0.25, 0.25, 0.5});
        fuzz::expect(at.face < history.triangles.size(), "a point on a face of the original");
        fuzz::expect(fuzz::is_finite(at.barycentric), "finite barycentrics");
        const SurfacePoint next = map.map_near(f, {0.5, 0.25, 0.25}, at);
        fuzz::expect(next.face < history.triangles.size(), "a nearby point on a face of the original");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    const auto history = fuzz::refusable("history", [&] { return read_history(in); });
    if (!history) return 0;
    const std::string text = text_of(*history);
    std::istringstream again(text);
    fuzz::expect(text_of(read_history(again)) == text, "a written history is the same when read again");
    use(*history);
    return 0;
}
