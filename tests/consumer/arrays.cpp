// Simplifies a mesh in flat arrays; includes only the standard library and faqem.
#include <faqem/simplify.hpp>

int main() {
    std::vector<float> positions;  // a flat grid of 20 x 20 squares
    std::vector<std::uint32_t> triangles;
    for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 20; ++j) positions.insert(positions.end(), {float(i), float(j), 0.0f});
    }
    for (std::uint32_t i = 0; i < 20; ++i) {
        for (std::uint32_t j = 0; j < 20; ++j) {
            const std::uint32_t a = i * 21 + j, b = a + 21;
            triangles.insert(triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
    const auto out = faqem::simplify({positions, triangles}, {.target = faqem::ratio(0.1)});
    return out.report.stop == faqem::StopReason::reached_target && out.mesh.triangles.size() <= 80 ? 0 : 1;
}
