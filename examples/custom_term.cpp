// The engine with rules of one's own, for a mesh that is to be computed with: no long edges (a veto), a foot
// that stays flat (a placement), and a liking for even faces (a term).

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

#include "faqem/asset.hpp"
#include "faqem/engine/custom_metric.hpp"
#include "faqem/engine/simplify_with.hpp"

using namespace faqem::engine;

int main(int argc, char** argv) try {
    if (argc != 4) throw std::invalid_argument("usage: custom_term IN OUT LONGEST-EDGE");
    const faqem::Asset model = faqem::load(argv[1]);
    const double longest = std::atof(argv[3]);
    faqem::Part part;
    part.positions = model.parts.at(0).positions;
    part.triangles = model.parts[0].triangles;
    double ground = part.positions.at(0)[1];
    for (const faqem::Vec3& p : part.positions) ground = std::min(ground, p[1]);

    const auto rules = [=](const AccumulatedMetric& planes, const CollapseMesh& mesh, faqem::Index u,
                           faqem::Index v, AllowedPosition allowed_position,
                           Candidate found) -> std::optional<Candidate> {
        const bool on_foot = mesh.position(u).y() == ground || mesh.position(v).y() == ground;
        if (on_foot && allowed_position == AllowedPosition::anywhere) {
            found.point.y() = ground;
            found.cost = std::max((planes.quadric(u) + planes.quadric(v))(found.point), 0.0);
        }
        double reach = 0;
        mesh.for_each_face_around(u, v, [&](faqem::Index f, unsigned) {
            for (const faqem::Index w : mesh.triangle(f))
                if (w != u && w != v) reach = std::max(reach, (mesh.position(w) - found.point).norm());
        });
        if (!(reach <= longest)) return std::nullopt;
        found.cost += 1e-4 * reach * reach;
        return found;
    };
    const CustomResult light =
        simplify_with({part.positions, part.triangles}, CustomMetric(AccumulatedMetric({}), rules),
                      {.rules = {.link = faqem::LinkCondition::on}, .ladder = Ladder::off});

    part.positions = light.mesh.positions;
    part.triangles = light.mesh.triangles;
    part.face_material.assign(part.triangles.size(), faqem::no_index);
    faqem::Asset result;
    result.parts = {part};
    faqem::save(result, argv[2], faqem::Overwrite::yes);
    std::cout << part.triangles.size() << " faces, no new edge longer than " << longest << "; "
              << name(light.loop.stop) << " that keeps to the rules\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << "custom_term: " << error.what() << "\n";
    return 1;
}
