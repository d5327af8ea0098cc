#include "faqem/detail/geometry/vertex_faces.hpp"

#include "support/catch.hpp"

using namespace faqem;
using detail::VertexFaces;

namespace {

std::vector<Index> list(const VertexFaces& around, Index v) { return {around[v].begin(), around[v].end()}; }

}  // namespace

TEST_CASE("vertex faces: listed in increasing order, without removed faces") {
    //  3---2
    //  | / |    vertex 4 is unreferenced
    //  0---1
    const std::vector<Triangle> faces = {{0, 1, 2}, {no_index, no_index, no_index}, {0, 2, 3}};
    const VertexFaces around = detail::make_vertex_faces(5, faces);
    CHECK(list(around, 0) == std::vector<Index>{0, 2});
    CHECK(list(around, 1) == std::vector<Index>{0});
    CHECK(list(around, 2) == std::vector<Index>{0, 2});
    CHECK(list(around, 3) == std::vector<Index>{2});
    CHECK(around[4].empty());
}
