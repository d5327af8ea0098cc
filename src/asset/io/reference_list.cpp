#include "asset/io/reference_list.hpp"

#include <system_error>

#include "faqem/error.hpp"

namespace faqem::detail {

namespace fs = std::filesystem;

void ReferenceList::add(const std::string& reference, ReferenceSyntax syntax, Readable readable,
                        const fs::path& subfolder) {
    fs::path named = referenced_path(folder_ / subfolder, reference, syntax);
    std::error_code error;
    if (which_ == References::all && fs::is_regular_file(named, error) && known_.insert(named).second) {
        canonical_.insert(fs::weakly_canonical(named, error));
        files_.push_back(std::move(named));
    }
    if (readable == Readable::no) return;
    try {
        add_found(finder_.find(reference, subfolder, syntax).file);
    } catch (const InputError&) {  // there is none
    }
}

void ReferenceList::add_found(const fs::path& file) {
    if (canonical_.insert(file).second && known_.insert(file).second) files_.push_back(file);
}

}  // namespace faqem::detail
