#include <string.h>

#include "check.h"

enum { side = 20 };

static float positions[3 * (side + 1) * (side + 1)];
static double double_positions[3 * (side + 1) * (side + 1)];
static uint32_t triangles[6 * side * side];

static faqem_mesh grid_without_positions(uint32_t n) {
    CHECK(n <= side);
    faqem_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    for (uint32_t i = 0; i <= n; ++i) {
        for (uint32_t j = 0; j <= n; ++j) {
            const double at[3] = {i, j, 0};
            for (int k = 0; k < 3; ++k) {
                double_positions[3 * mesh.vertex_count + k] = at[k];
                positions[3 * mesh.vertex_count + k] = (float)at[k];
            }
            ++mesh.vertex_count;
        }
    }
    for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = 0; j < n; ++j) {
            const uint32_t a = i * (n + 1) + j, b = a + n + 1;
            const uint32_t corners[6] = {a, b, b + 1, a, b + 1, a + 1};
            memcpy(triangles + 3 * mesh.face_count, corners, sizeof corners);
            mesh.face_count += 2;
        }
    }
    mesh.triangles = triangles;
    return mesh;
}

faqem_mesh flat_grid(uint32_t n) {
    faqem_mesh mesh = grid_without_positions(n);
    mesh.positions = positions;
    return mesh;
}

faqem_mesh flat_grid_of_doubles(uint32_t n) {
    faqem_mesh mesh = grid_without_positions(n);
    mesh.double_positions = double_positions;
    return mesh;
}

int main(int argc, char** argv) {
    const char* wanted = argc > 1 ? argv[1] : "";
    int ran = 0;
    if (!*wanted || strcmp(wanted, "simplify") == 0) ++ran, test_simplify();
    if (!*wanted || strcmp(wanted, "layout") == 0) ++ran, test_layout();
    if (!*wanted || strcmp(wanted, "options") == 0) ++ran, test_options();
    if (!*wanted || strcmp(wanted, "levels") == 0) ++ran, test_levels();
#ifdef FAQEM_HAS_ASSET
    if (!*wanted || strcmp(wanted, "asset") == 0) ++ran, test_asset();
    if (!*wanted || strcmp(wanted, "asset_levels") == 0) ++ran, test_asset_levels();
    if (!*wanted || strcmp(wanted, "asset_textures") == 0) ++ran, test_asset_textures();
#endif
    CHECK(ran > 0);
    return 0;
}
