// Reduces a mesh to a tenth.
#include <vector>
#include "faqem/simplify.hpp"
int main() {
    std::vector<faqem::Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<faqem::Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
    faqem::Options options;
    options.target = faqem::ratio(0.1);
    return static_cast<int>(faqem::simplify({positions, triangles}, options).mesh.triangles.size()) == 0;
}
