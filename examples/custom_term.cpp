// The engine with custom rules, for a mesh that is used in a computation: no edge longer than a limit (a
// veto), a base that remains flat (a placement), and a preference for short edges (a term).

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

#include "faqem/asset.hpp"
#include "faqem/engine/custom_metric.hpp"
#include "faqem/engine/simplify_with.hpp"

using namespace faqem::engine;

int main(int argc, char** argv) try {
    if (argc != 4) throw std::invalid_argument("usage: custom_term IN OUT MAX-EDGE-LENGTH");
    const faqem::Asset model = faqem::load(argv[1]);
    const double max_length = std::atof(argv[3]);
    faqem::Part part;
    part.positions = model.parts.at(0).positions;
    part.triangles = model.parts[0].triangles;
    double base_height = part.positions.at(0)[1];
    for (const faqem::Vec3& p : part.positions) base_height = std::min(base_height, p[1]);

    const auto rules = [=](const AccumulatedMetric& planes, const CollapseMesh& mesh, faqem::Index u,
                           faqem::Index v, AllowedPosition allowed_position,
                           Candidate candidate) -> std::optional<Candidate> {
        const bool is_on_base = mesh.position(u).y() == base_height || mesh.position(v).y() == base_height;
        if (is_on_base && allowed_position == AllowedPosition::anywhere) {
            candidate.point.y() = base_height;
            candidate.cost = std::max((planes.quadric(u) + planes.quadric(v))(candidate.point), 0.0);
        }
        double length = 0;
        mesh.for_each_face_around(u, v, [&](faqem::Index f, unsigned) {
            for (const faqem::Index w : mesh.triangle(f))
                if (w != u && w != v) length = std::max(length, (mesh.position(w) - candidate.point).norm());
        });
        if (!(length <= max_length)) return std::nullopt;
        candidate.cost += 1e-4 * length * length;
        return candidate;
    };
    const CustomResult simplified =
        simplify_with({part.positions, part.triangles}, CustomMetric(AccumulatedMetric({}), rules),
                      {.rules = {.link = faqem::LinkCondition::on}, .ladder = Ladder::off});

    part.positions = simplified.mesh.positions;
    part.triangles = simplified.mesh.triangles;
    part.face_material.assign(part.triangles.size(), faqem::no_index);
    faqem::Asset result;
    result.parts = {part};
    faqem::save(result, argv[2], faqem::Overwrite::yes);
    std::cout << part.triangles.size() << " faces, no new edge longer than " << max_length
              << "; stop reason: " << name(simplified.loop.stop) << "\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << "custom_term: " << error.what() << "\n";
    return 1;
}
