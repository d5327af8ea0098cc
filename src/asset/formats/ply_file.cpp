#include "asset/formats/ply_file.hpp"

#include <fstream>
#include <string_view>

#include "asset/formats/formats.hpp"

namespace faqem::detail {
namespace {

NumberType read_type(TextScanner& in) {
    // By NumberType, from i8 on.
    static constexpr std::array<std::array<std::string_view, 2>, 8> names = {{{"char", "int8"},
                                                                              {"uchar", "uint8"},
                                                                              {"short", "int16"},
                                                                              {"ushort", "uint16"},
                                                                              {"int", "int32"},
                                                                              {"uint", "uint32"},
                                                                              {"float", "float32"},
                                                                              {"double", "float64"}}};
    const std::string_view word = in.word();
    const auto found =
        std::ranges::find_if(names, [&](const auto& entry) { return entry[0] == word || entry[1] == word; });
    if (found == names.end()) in.fail("unknown type " + TextScanner::quoted(word));
    return static_cast<NumberType>(static_cast<std::uint32_t>(NumberType::i8) + (found - names.begin()));
}

PlyFormat read_format(TextScanner& in) {
    const std::string_view name = in.word();
    if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
        in.fail("unknown format " + TextScanner::quoted(name));
    if (in.word() != "1.0") in.fail("only version 1.0 is supported");
    return name == "ascii"                  ? PlyFormat::ascii
           : name == "binary_little_endian" ? PlyFormat::little_endian
                                            : PlyFormat::big_endian;
}

PlyProperty read_property(TextScanner& in) {
    PlyProperty property;
    property.is_list = in.accept_word("list");
    if (property.is_list) {
        property.count_type = read_type(in);
        if (!is_integer(property.count_type)) in.fail("the length of a list must be an integer");
    }
    property.type = read_type(in);
    property.name = in.word();
    if (property.name.empty()) in.fail("a property has no name");
    return property;
}

}  // namespace

PlyHeader read_ply_header(std::span<const std::uint8_t> bytes, const std::string& file) {
    PlyHeader header;
    TextScanner in(bytes, file, Continuation::no);
    if (in.word() != "ply") in.fail("is not a PLY file: it does not start with 'ply'");
    in.finish_line();
    bool has_format = false;
    for (;;) {
        if (!in.skip_to_content()) in.fail("the header has no end_header");
        const std::string_view key = in.word();
        if (key == "end_header") break;
        if (key == "format") {
            header.format = read_format(in);
            has_format = true;
        } else if (key == "element") {
            const std::string name(in.word());
            header.elements.push_back({name, in.number<std::uint64_t>(), {}});
        } else if (key == "property") {
            if (header.elements.empty()) in.fail("a property before the first element");
            header.elements.back().properties.push_back(read_property(in));
        } else if (key == "comment" || key == "obj_info") {
            if (in.accept_word("TextureFile")) header.texture_files.push_back(in.rest_of_line());
            in.next_line();
            continue;
        } else {
            in.fail("unknown statement " + TextScanner::quoted(key));
        }
        in.finish_line();
    }
    if (!has_format) in.fail("the header has no format");
    // Exactly one line end of the same kind as in the first line is skipped: the next byte belongs to the
    // data, even if it is a line feed.
    const bool lone_cr = bytes.size() > 4 && bytes[3] == '\r' && bytes[4] != '\n';
    const std::string_view rest = in.remaining();
    const std::size_t end =
        rest.starts_with("\r\n") && !lone_cr ? 2 : rest.starts_with('\n') || rest.starts_with('\r');
    if (end == 0) in.fail("end_header must be followed by a line end");
    header.size = bytes.size() - rest.size() + end;
    header.lines = in.line();
    return header;
}

void list_ply_references(const std::filesystem::path& model, ReferenceList& files) {
    std::vector<std::uint8_t> header(std::size_t{1} << 20);  // longer ones do not occur
    std::ifstream in(model, std::ios::binary);
    in.read(reinterpret_cast<char*>(header.data()), static_cast<std::streamsize>(header.size()));
    header.resize(static_cast<std::size_t>(in.gcount()));
    for (TextScanner text(header, model.string(), Continuation::no); text.skip_to_content();
         text.next_line()) {
        const std::string_view key = text.word();
        if (key == "end_header") break;
        if ((key != "comment" && key != "obj_info") || !text.accept_word("TextureFile")) continue;
        files.add(text.rest_of_line(), ReferenceSyntax::file_name, Readable::yes);
    }
}

}  // namespace faqem::detail
