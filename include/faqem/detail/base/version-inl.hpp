#include "faqem/version.hpp"

namespace faqem {

std::string_view version() { return FAQEM_VERSION; }

}  // namespace faqem
