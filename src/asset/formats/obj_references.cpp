#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <string_view>

#include "asset/formats/formats.hpp"
#include "asset/formats/mtl.hpp"
#include "asset/formats/obj_tiles.hpp"
#include "asset/io/file_finder.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Calls visit(name) for the file names that a statement may contain. Options before a name are not
/// interpreted: any word may be the name or, because names may contain blanks, its start.
template <class Visit>
void for_each_possible_name(const std::string& statement, const Visit& visit) {
    constexpr std::size_t max_path = 4096;  // longer names are not valid
    constexpr const char* blanks = " \t";
    for (std::size_t first = 0; first < statement.size();) {
        const std::size_t end = std::min(statement.find_first_of(blanks, first), statement.size());
        if (statement.size() - first <= max_path) visit(statement.substr(first));
        if (end - first <= max_path) visit(statement.substr(first, end - first));
        first = std::min(statement.find_first_not_of(blanks, end), statement.size());
    }
}

/// Calls visit(scanner) for each block of whole lines of a file, which may be larger than the memory.
template <class Visit>
void for_each_block(const fs::path& file, const Visit& visit) {
    constexpr std::size_t block_size = std::size_t{1} << 20;
    std::ifstream in(file, std::ios::binary);
    std::string text;
    for (std::string line; std::getline(in, line);) {
        text += line + '\n';
        const bool is_last = in.peek() == std::ifstream::traits_type::eof();
        const bool is_continued = line.ends_with('\\') || line.ends_with("\\\r");
        if (!is_last && (is_continued || text.size() < block_size)) continue;
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
        visit(TextScanner({bytes, text.size()}, file.string(), Continuation::yes));
        text.clear();
    }
}

/// Collects the libraries and textures of one model.
struct LibraryReferences {
    const fs::path& model;
    ReferenceList& files;
    std::set<std::string> names = {};
    std::set<fs::path> libraries = {};

    /// Adds a library and its textures, which are relative to its folder.
    void add(const std::string& name) {
        if (!names.insert(name).second) return;
        files.add(name, ReferenceSyntax::file_name, Readable::yes);
        try {
            const fs::path library = find_library(name, model, files.finder()).file;
            files.add_found(library);
            if (!libraries.insert(library).second) return;
            const fs::path& folder = files.finder().folder();
            const fs::path root = fs::canonical(folder.empty() ? "." : folder);
            const fs::path subfolder = library.parent_path().lexically_relative(root);
            const std::vector<std::uint8_t> text = read_file(library);
            for (const std::string& statement : texture_statements(text, library.string()))
                for_each_possible_name(statement,
                                       [&](const std::string& texture) { add_texture(texture, subfolder); });
        } catch (const InputError&) {  // may not be read
        }
    }

    void add_texture(const std::string& name, const fs::path& subfolder) {
        for (std::uint32_t tile = first_tile; tile <= last_tile; ++tile) {
            const std::string file = tile_file_name(name, tile);
            files.add(file, ReferenceSyntax::file_name, Readable::yes, subfolder);
            if (file == name) break;  // it has no tiles
        }
    }
};

}  // namespace

void list_library_references(const fs::path& library, ReferenceList& files) {
    LibraryReferences{library, files}.add(library.filename().string());
}

void list_obj_references(const fs::path& model, ReferenceList& files) {
    static constexpr std::array<std::string_view, 4> others = {"maplib", "shadow_obj", "trace_obj", "call"};
    LibraryReferences libraries{model, files};
    for_each_block(model, [&](TextScanner in) {
        for (; in.skip_to_content(); in.next_line()) {
            const std::string_view key = in.word();
            if (key == "mtllib") {
                const std::string statement = in.rest_of_line();
                const auto add = [&](const std::string& name) { libraries.add(name); };
                for (const std::string& name : library_names(statement, files.finder().folder())) add(name);
                for_each_possible_name(statement, add);
            } else if (std::ranges::find(others, key) != others.end()) {
                for_each_possible_name(in.rest_of_line(), [&](const std::string& name) {
                    files.add(name, ReferenceSyntax::file_name, Readable::no);
                });
            }
        }
    });
}

}  // namespace faqem::detail
