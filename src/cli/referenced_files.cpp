#include "cli/referenced_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <string_view>
#include <utility>

#include "asset/formats/mtl.hpp"
#include "asset/formats/obj.hpp"
#include "asset/formats/ply_header.hpp"
#include "asset/io/file.hpp"
#include "asset/io/file_format.hpp"
#include "asset/text/text_scanner.hpp"
#include "cli/json.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;
using detail::ReferenceSyntax;

/// Whether load() may read a file.
enum class Readable { no, yes };

std::span<const std::uint8_t> bytes_of(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Collects the files that references of a model name.
class FileCollector {
public:
    FileCollector(const fs::path& model, References which) : folder_(model.parent_path()), which_(which) {}

    const fs::path& folder() const { return folder_; }

    /// \param subfolder  of the file with the reference, relative to the folder of the model
    void add(const std::string& reference, ReferenceSyntax syntax, Readable readable,
             const fs::path& subfolder = {}) {
        fs::path file;
        std::error_code error;
        if (which_ == References::all) {
            file = detail::referenced_path(folder_ / subfolder, reference, syntax);
            if (!fs::is_regular_file(file, error)) return;
        } else if (readable == Readable::yes) {
            try {
                const fs::path from_model = subfolder / reference;
                file = detail::resolve_inside(folder_, from_model.generic_string(), syntax);
            } catch (const InputError&) {
                return;
            }
        } else {
            return;
        }
        if (known_.insert(file).second) files_.push_back(std::move(file));
    }

    std::vector<fs::path> finish() { return std::move(files_); }

private:
    fs::path folder_;
    References which_;
    std::vector<fs::path> files_;
    std::set<fs::path> known_;
};

/// Finds the URIs of a glTF document. It handles the events of the parser, so that large, damaged and deeply
/// nested documents need no memory.
class UriFinder : public Json::json_sax_t {
public:
    explicit UriFinder(FileCollector& files) : files_(files) {}

    bool key(std::string& name) override {
        key_ = name;
        if (depth_ == 1) section_ = name;
        return true;
    }

    bool string(std::string& value) override {
        if (!is_uri_key() || value.starts_with("data:")) return true;
        const bool is_read = depth_ == 3 && (section_ == "buffers" || section_ == "images");
        files_.add(value, ReferenceSyntax::uri, is_read ? Readable::yes : Readable::no);
        // load() takes the text after a ? or # as part of the name, other programs as a query or fragment.
        const std::size_t end = value.find_first_of("?#");
        if (end != std::string::npos) files_.add(value.substr(0, end), ReferenceSyntax::uri, Readable::no);
        return true;
    }

    bool start_object(std::size_t) override { return ++depth_, true; }
    bool start_array(std::size_t) override { return ++depth_, true; }
    bool end_object() override { return --depth_, true; }
    bool end_array() override { return --depth_, true; }
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(Json::number_integer_t) override { return true; }
    bool number_unsigned(Json::number_unsigned_t) override { return true; }
    bool number_float(Json::number_float_t, const std::string&) override { return true; }
    bool binary(Json::binary_t&) override { return true; }
    bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }

private:
    /// `uri`, and names that end with it, as schemaUri of EXT_structural_metadata.
    bool is_uri_key() const { return key_.ends_with("uri") || key_.ends_with("Uri"); }

    FileCollector& files_;
    std::size_t depth_ = 0;
    std::string key_, section_;  // the last key, and the last key of the top level
};

void add_gltf_references(const fs::path& model, FileCollector& files) {
    // The JSON of a GLB file is its first chunk, after a file header of 12 bytes and a chunk header of 8 bytes.
    std::ifstream in(model, std::ios::binary);
    std::array<char, 20> head = {};
    const bool is_glb = in.read(head.data(), head.size()) && std::string_view(head.data(), 4) == "glTF";
    in.clear();
    if (!is_glb) in.seekg(0);
    UriFinder finder(files);
    constexpr bool strict = false;  // other chunks may follow
    static_cast<void>(Json::sax_parse(in, &finder, Json::input_format_t::json, strict));
}

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

/// Returns the length of the lines that are complete: the last one does not continue after a backslash.
std::size_t complete_lines_size(std::string_view text) {
    constexpr std::string_view line_ends = "\r\n";
    for (std::size_t end = text.find_last_of(line_ends); end != std::string_view::npos;) {
        const std::size_t last = text.find_last_not_of(line_ends, end);
        if (last == std::string_view::npos || text[last] != '\\') return end + 1;
        end = text.find_last_of(line_ends, last);
    }
    return 0;
}

/// Calls visit(scanner) for each block of whole lines of a file, which may be larger than the memory.
template <class Visit>
void for_each_block(const fs::path& file, const Visit& visit) {
    std::ifstream in(file, std::ios::binary);
    std::size_t block_size = std::size_t{1} << 20;
    for (std::string text; in;) {
        const std::size_t rest = text.size();
        text.resize(rest + block_size);
        in.read(text.data() + rest, static_cast<std::streamsize>(block_size));
        text.resize(rest + static_cast<std::size_t>(in.gcount()));
        const std::size_t size = in ? complete_lines_size(text) : text.size();
        if (size == 0) block_size *= 2;
        visit(detail::TextScanner(bytes_of(std::string_view(text).substr(0, size)), file.string(),
                                  detail::Continuation::yes));
        text.erase(0, size);
    }
}

/// Adds a library and its textures, which are relative to its folder.
void add_library(const std::string& name, FileCollector& files, std::set<fs::path>& known) {
    files.add(name, ReferenceSyntax::file_name, Readable::yes);
    try {
        const fs::path library = detail::resolve_inside(files.folder(), name, ReferenceSyntax::file_name);
        if (!known.insert(library).second) return;
        const fs::path root = fs::canonical(files.folder().empty() ? "." : files.folder());
        const fs::path subfolder = library.parent_path().lexically_relative(root);
        const std::vector<std::uint8_t> text = detail::read_file(library);
        for (const std::string& statement : detail::texture_statements(text, library.string()))
            for_each_possible_name(statement, [&](const std::string& texture) {
                files.add(texture, ReferenceSyntax::file_name, Readable::yes, subfolder);
            });
    } catch (const InputError&) {  // may not be read
    }
}

void add_obj_references(const fs::path& model, FileCollector& files) {
    static constexpr std::array<std::string_view, 4> others = {"maplib", "shadow_obj", "trace_obj", "call"};
    std::set<fs::path> libraries;
    for_each_block(model, [&](detail::TextScanner in) {
        for (; in.skip_to_content(); in.next_line()) {
            const std::string_view key = in.word();
            if (key == "mtllib") {
                const std::string statement = in.rest_of_line();
                const auto add = [&](const std::string& name) { add_library(name, files, libraries); };
                for (const std::string& name : detail::library_names(statement, files.folder())) add(name);
                for_each_possible_name(statement, add);
            } else if (std::find(others.begin(), others.end(), key) != others.end()) {
                for_each_possible_name(in.rest_of_line(), [&](const std::string& name) {
                    files.add(name, ReferenceSyntax::file_name, Readable::no);
                });
            }
        }
    });
}

void add_ply_references(const fs::path& model, FileCollector& files) {
    std::string header(std::size_t{1} << 20, ' ');  // longer ones do not occur
    std::ifstream in(model, std::ios::binary);
    in.read(header.data(), static_cast<std::streamsize>(header.size()));
    header.resize(static_cast<std::size_t>(in.gcount()));
    for (const std::string& name : detail::ply_texture_files(bytes_of(header), model.string()))
        files.add(name, ReferenceSyntax::file_name, Readable::no);
}

}  // namespace

std::vector<fs::path> referenced_files(const fs::path& model, References which) {
    FileCollector files(model, which);
    std::error_code error;
    if (!fs::is_regular_file(model, error)) return {};  // opening a pipe would block
    try {
        if (detail::lower_case_extension(model) == ".mtl") {
            std::set<fs::path> libraries;
            add_library(model.filename().string(), files, libraries);
            return files.finish();
        }
        const detail::Format format = detail::format_of_file(model);
        if (format == detail::Format::obj) add_obj_references(model, files);
        if (format == detail::Format::ply) add_ply_references(model, files);
        if (format == detail::Format::gltf) add_gltf_references(model, files);
    } catch (const fs::filesystem_error&) {  // the model was removed
    }
    return files.finish();
}

std::string modification_stamp(const std::vector<fs::path>& files) {
    std::string text;
    for (const fs::path& file : files) {
        struct stat status = {};
        if (::stat(file.c_str(), &status) != 0) continue;
        for (const auto number :
             {static_cast<std::int64_t>(status.st_size), static_cast<std::int64_t>(status.st_mtim.tv_sec),
              static_cast<std::int64_t>(status.st_mtim.tv_nsec)}) {
            if (!text.empty()) text += ' ';
            text += std::to_string(number);
        }
    }
    return text;
}

std::uint64_t total_file_size(const std::vector<fs::path>& files) {
    std::uint64_t sum = 0;
    for (const fs::path& file : files) {
        struct stat status = {};
        if (::stat(file.c_str(), &status) == 0) sum += static_cast<std::uint64_t>(status.st_size);
    }
    return sum;
}

}  // namespace faqem::cli
