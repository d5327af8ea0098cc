#include "asset/io/reference_list.hpp"

#include <system_error>

#include "faqem/error.hpp"

namespace faqem::detail {

namespace fs = std::filesystem;

void ReferenceList::add(const std::string& reference, ReferenceSyntax syntax, Readable readable,
                        const fs::path& subfolder) {
    add_named(reference, syntax, readable, subfolder);
    if (readable == Readable::no) return;
    try {
        add_found(finder_.find(reference, subfolder, syntax).file);
    } catch (const InputError&) {  // there is none
    }
}

void ReferenceList::add_named(const std::string& reference, ReferenceSyntax syntax, Readable readable,
                              const fs::path& subfolder) {
    fs::path file;
    std::error_code error;
    if (which_ == References::all) {
        file = referenced_path(folder_ / subfolder, reference, syntax);
        if (!fs::is_regular_file(file, error)) return;
    } else if (readable == Readable::yes) {
        try {
            const fs::path from_model = subfolder / reference;
            file = resolve_inside(folder_, from_model.generic_string(), syntax);
        } catch (const InputError&) {
            return;
        }
    } else {
        return;
    }
    if (!known_.insert(file).second) return;
    canonical_.insert(fs::weakly_canonical(file, error));
    files_.push_back(std::move(file));
}

void ReferenceList::add_found(const fs::path& file) {
    if (canonical_.insert(file).second && known_.insert(file).second) files_.push_back(file);
}

}  // namespace faqem::detail
