#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include <algorithm>

#include "faqem/detail/base/stopwatch.hpp"
#include "simplifier.hpp"

namespace faqem::bench {

Outcome vtk(const TriangleMesh& in, std::size_t target_faces) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(in.positions.size()));
    for (std::size_t v = 0; v < in.positions.size(); ++v) {
        points->SetPoint(static_cast<vtkIdType>(v), in.positions[v].data());
    }
    vtkNew<vtkCellArray> faces;
    for (const Triangle& t : in.triangles) {
        const vtkIdType corners[] = {t[0], t[1], t[2]};
        faces->InsertNextCell(3, corners);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(faces);

    vtkNew<vtkQuadricDecimation> decimation;
    decimation->SetInputData(data);
    decimation->SetTargetReduction(
        std::max(0.0, 1 - static_cast<double>(target_faces) / static_cast<double>(in.triangles.size())));
    const detail::Stopwatch core;
    decimation->Update();
    const double seconds = core.seconds();

    vtkPolyData* result = decimation->GetOutput();
    TriangleMesh mesh;
    mesh.positions.resize(static_cast<std::size_t>(result->GetNumberOfPoints()));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        result->GetPoint(static_cast<vtkIdType>(v), mesh.positions[v].data());
    }
    vtkNew<vtkIdList> corners;
    for (vtkIdType f = 0; f < result->GetNumberOfCells(); ++f) {
        result->GetCellPoints(f, corners);
        if (corners->GetNumberOfIds() != 3) continue;
        mesh.triangles.push_back({static_cast<Index>(corners->GetId(0)),
                                  static_cast<Index>(corners->GetId(1)),
                                  static_cast<Index>(corners->GetId(2))});
    }
    return {std::move(mesh), seconds, {}};
}

}  // namespace faqem::bench
