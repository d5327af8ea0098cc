#include "asset/gltf/write/gpu_order.hpp"

#include <cstddef>
#include <utility>

#ifdef FAQEM_WITH_MESHOPT
#include <meshoptimizer.h>
#endif

namespace faqem::detail {

#ifdef FAQEM_WITH_MESHOPT

void order_for_gpu(std::vector<Index>& vertices, std::vector<Index>& corners) {
    const std::size_t count = vertices.size();
    meshopt_optimizeVertexCache(corners.data(), corners.data(), corners.size(), count);
    std::vector<Index> moved(count), ordered(count);
    meshopt_optimizeVertexFetchRemap(moved.data(), corners.data(), corners.size(), count);
    for (Index& corner : corners) corner = moved[corner];
    for (std::size_t i = 0; i < count; ++i) ordered[moved[i]] = vertices[i];
    vertices = std::move(ordered);
}

#else

void order_for_gpu(std::vector<Index>&, std::vector<Index>&) {}

#endif

}  // namespace faqem::detail
