#include "faqem/eigen.hpp"

#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

TEST_CASE("matrices of Eigen give the result of the arrays, in any storage order") {
    const TriangleMesh mesh = test::shaken(test::grid(8), 0.2, 3);
    const Eigen::MatrixXd vertices = to_matrix(mesh.positions);
    const Eigen::MatrixXi triangles = to_matrix(mesh.triangles);
    REQUIRE((vertices.rows() == 81 && triangles.rows() == 128));
    CHECK(vertices(80, 1) == mesh.positions[80][1]);
    const TriangleMesh expected = simplify(mesh.view(), {.target = ratio(0.5)}).mesh;
    const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = vertices;
    const Eigen::Map<const Eigen::MatrixXd> map(vertices.data(), vertices.rows(), 3);
    const Eigen::Ref<const Eigen::MatrixXi> ref = triangles;
    for (const MeshView& view :
         {eigen_view(vertices, triangles), eigen_view(rows, triangles), eigen_view(map, ref)}) {
        const TriangleMesh made = simplify(view, {.target = ratio(0.5)}).mesh;
        CHECK(made.positions == expected.positions);
        CHECK(made.triangles == expected.triangles);
    }
}

TEST_CASE("a matrix with other than three columns is an error") {
    CHECK_THROWS_WITH(eigen_view(Eigen::MatrixXd(3, 4), Eigen::MatrixXi(4, 3)),
                      "vertices: the matrix has 4 columns instead of 3: transpose it");
    CHECK_THROWS_AS(eigen_view(Eigen::MatrixXf(4, 3), Eigen::MatrixXi(3, 4)), InputError);
}
