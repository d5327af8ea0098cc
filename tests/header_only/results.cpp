#include "header_only/results.hpp"

#include <faqem/compare.hpp>
#include <faqem/forward_map.hpp>
#include <faqem/levels.hpp>
#include <faqem/simplify.hpp>
#include <faqem/surface_map.hpp>
#include <faqem/truncate.hpp>
#include <faqem/version.hpp>

#include <fstream>
#include <iostream>

#include "header_only/models.hpp"

namespace {

class Writer {
public:
    explicit Writer(const char* file) : out_(file, std::ios::binary) {}

    template <class T>
    void value(const T& value) {
        out_.write(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class T>
    void array(const std::vector<T>& values) {
        value(values.size());
        out_.write(reinterpret_cast<const char*>(values.data()),
                   static_cast<std::streamsize>(values.size() * sizeof(T)));
    }
    void result(const faqem::SimplifyResult& result) {
        array(result.mesh.positions);
        array(result.mesh.triangles);
        array(result.vertex_origin);
        array(result.face_origin);
        value(result.report.collapses);
        value(result.report.refusals);
        value(result.report.rungs);
        if (!result.history.empty()) write(result.history, out_);
    }
    bool good() { return out_.flush().good(); }

private:
    std::ofstream out_;
};

void write_mapping(const faqem::TriangleMesh& mesh, const faqem::CollapseHistory& history, Writer& out) {
    const faqem::SurfaceMap map(history);
    for (faqem::Index face = 0; face < mesh.triangles.size(); face += 7) {
        const faqem::SurfacePoint point = map.map(face, {0.2, 0.3, 0.5});
        out.value(point.face);
        out.value(point.barycentric);
    }
}

}  // namespace

bool write_results(const char* file) {
    Writer out(file);
    for (const faqem::TriangleMesh& model :
         {models::wavy_grid(60), models::open_tube(40, 30), models::fins(12)}) {
        const faqem::MeshView view{model.positions, model.triangles};
        for (const faqem::Preset preset : faqem::all_presets) {
            const faqem::Options options{.target = faqem::ratio(0.1),
                                         .preset = preset,
                                         .topology = {.virtual_edges = faqem::VirtualEdges::on},
                                         .history = faqem::Recording::on};
            const faqem::SimplifyResult result = faqem::simplify(view, options);
            out.result(result);
            out.value(faqem::hausdorff(view, {result.mesh.positions, result.mesh.triangles}).bound);
            write_mapping(result.mesh, result.history, out);
            out.array(faqem::vertex_map(result.history));
        }
        out.result(faqem::simplify(view, {.max_error = faqem::of_diagonal(0.01)}));
        std::vector<faqem::CollapseHistory> histories;
        for (const auto& level : faqem::simplify_levels(view, {faqem::ratio(0.5), faqem::ratio(0.1)},
                                                        {.history = faqem::Recording::on})) {
            out.result(level.result);
            histories.push_back(level.result.history);
        }
        const faqem::TriangleMesh truncated = replay(faqem::truncate_to_faces(faqem::join(histories), 200));
        out.array(truncated.positions);
        out.array(truncated.triangles);
        out.value(
            faqem::compare(view, {truncated.positions, truncated.triangles}, {.samples = 1000}).chamfer);
    }
    std::cout << "faqem " << faqem::version() << "\n";
    return out.good();
}

extern "C" unsigned long SIMPLIFY_SQUARE(double ratio) {
    const faqem::TriangleMesh mesh = models::wavy_grid(20);
    return faqem::simplify({mesh.positions, mesh.triangles}, {.target = faqem::ratio(ratio)})
        .mesh.triangles.size();
}
