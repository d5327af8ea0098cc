#pragma once
/// \file
/// Names of the glTF extensions that compress geometry.

namespace faqem::detail {

inline constexpr const char* meshopt_name = "EXT_meshopt_compression";
inline constexpr const char* draco_name = "KHR_draco_mesh_compression";

}  // namespace faqem::detail
