#include "cli/process/json.hpp"

namespace faqem::cli {

Json info_json(const MeshInfo& info) {
    return {{"faces", info.faces},
            {"degenerate_faces", info.degenerate_faces},
            {"vertices", info.vertices},
            {"components", info.components},
            {"boundary_edges", info.boundary_edges},
            {"nonmanifold_edges", info.nonmanifold_edges},
            {"euler", info.euler},
            {"box_min", info.box_min},
            {"box_max", info.box_max},
            {"diagonal", info.diagonal},
            {"area", info.area}};
}

std::string json_text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string json_line(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace faqem::cli
