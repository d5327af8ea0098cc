#include "cli/process/shown_text.hpp"

#include <iomanip>
#include <sstream>

namespace faqem::cli {

std::string shown_bytes(std::uint64_t bytes) {
    if (bytes < 1000) return std::to_string(bytes) + " bytes";
    std::ostringstream out;
    out << std::fixed << std::setprecision(1);
    if (bytes < 999'950)
        out << static_cast<double>(bytes) / 1e3 << " kB";
    else
        out << static_cast<double>(bytes) / 1e6 << " MB";
    return out.str();
}

}  // namespace faqem::cli
