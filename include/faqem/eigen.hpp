#pragma once
/// \file
/// Matrices of Eigen, whose rows are vertices or triangles, as input and output. Needs Eigen.

#include <Eigen/Core>
#include <string>

#include "faqem/error.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN

/// Views matrices as a mesh, for example simplify(eigen_view(V, F)). They are not copied and must outlive the view.
/// \param vertices   (v, 3) of double or float, in any storage order; a matrix, array, Map, Ref or block of one
/// \param triangles  (f, 3) of int or unsigned with 16 or 32 bits; negative indices are out of range
/// \throws InputError  a matrix has another number of columns
template <class Vertices, class Triangles>
MeshView eigen_view(const Eigen::DenseBase<Vertices>& vertices,
                    const Eigen::DenseBase<Triangles>& triangles) {
    const auto view = [](const auto& matrix, const char* name, auto make) {
        const std::size_t size = sizeof *matrix.data(), rows = std::size_t(matrix.rows());
        if (matrix.cols() != 3)
            throw InputError("", name,
                             "the matrix has " + std::to_string(matrix.cols()) + " columns instead of 3" +
                                 (matrix.rows() == 3 ? ": transpose it" : ""));
        return make(matrix.data(), rows, std::size_t(matrix.rowStride()) * size,
                    std::size_t(matrix.colStride()) * size);
    };
    return {view(vertices.derived(), "vertices", [](auto... layout) { return PositionView(layout...); }),
            view(triangles.derived(), "triangles", [](auto... layout) { return TriangleView(layout...); })};
}

/// Copies positions to a matrix (v, 3). O(v)
inline Eigen::MatrixXd to_matrix(const std::vector<Vec3>& positions) {
    return Eigen::MatrixXd::NullaryExpr(
        static_cast<Eigen::Index>(positions.size()), 3,
        [&](Eigen::Index v, Eigen::Index k) { return positions[std::size_t(v)][std::size_t(k)]; });
}

/// Copies triangles to a matrix (f, 3). O(f)
inline Eigen::MatrixXi to_matrix(const std::vector<Triangle>& triangles) {
    return Eigen::MatrixXi::NullaryExpr(
        static_cast<Eigen::Index>(triangles.size()), 3,
        [&](Eigen::Index f, Eigen::Index k) { return int(triangles[std::size_t(f)][std::size_t(k)]); });
}

FAQEM_NAMESPACE_END
