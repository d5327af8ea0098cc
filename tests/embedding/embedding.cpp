#include <faqem/simplify.hpp>
#include <faqem/version.hpp>

std::size_t faces_of(const faqem::SimplifyResult& result) { return result.mesh.triangles.size(); }
