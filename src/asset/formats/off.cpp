#include "asset/formats/formats.hpp"

#include "asset/scene/messages.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "asset/formats/polygon_content.hpp"
#include "asset/image/srgb.hpp"
#include "asset/scene/repair.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// Vertex attributes declared by the keyword, for example STCNOFF.
struct Keyword {
    bool uvs = false, colors = false, normals = false;
};

Keyword read_keyword(TextScanner& in) {
    Keyword keyword;
    in.skip_to_content();
    const std::string_view rest = in.remaining();
    if (rest.empty()) in.fail("the file is empty");
    if ((rest[0] >= '0' && rest[0] <= '9' && rest.substr(0, 2) != "4O" && rest.substr(0, 2) != "4n"))
        return keyword;
    std::string_view word = in.word();
    const auto take = [&](std::string_view prefix) {
        if (!word.starts_with(prefix)) return false;
        word.remove_prefix(prefix.size());
        return true;
    };
    const std::string_view whole = word;
    keyword.uvs = take("ST");
    keyword.colors = take("C");
    keyword.normals = take("N");
    const bool other_dimension = take("4nOFF") || take("4OFF") || take("nOFF");
    if (other_dimension)
        throw UnsupportedError(in.file(), "line " + std::to_string(in.line()),
                               "'" + std::string(whole) + "': only three-dimensional OFF is supported");
    if (word != "OFF") in.fail("is not an OFF file: " + TextScanner::quoted(whole));
    if (in.accept_word("BINARY"))
        throw UnsupportedError(in.file(), "line " + std::to_string(in.line()), "binary OFF is not supported");
    return keyword;
}

/// The components of a colour: integers in [0, 255], or floats in [0, 1] if one has a decimal point.
struct ColorWords {
    std::array<double, 4> rgba = {0, 0, 0, 1};
    std::size_t size = 0;
    bool integers = true;

    /// \pre size is 3 or 4
    Vec4f linear() const {
        const double unit = integers ? 255 : 1;
        Vec4f color;
        for (std::size_t k = 0; k < 3; ++k) color[k] = static_cast<float>(linear_from_srgb(rgba[k] / unit));
        color[3] = static_cast<float>(size == 3 ? 1 : rgba[3] / unit);
        return color;
    }
};

/// Parser of an OFF file.
class OffReader {
public:
    OffReader(std::span<const std::uint8_t> text, const std::filesystem::path& file)
        : in_(text, file.string(), Continuation::no), file_(file) {}

    Asset run() {
        keyword_ = read_keyword(in_);
        const std::uint64_t vertices = count("vertices"), faces = count("faces");
        if (!in_.at_line_end()) in_.number<std::uint64_t>();
        in_.finish_line();
        // A vertex takes at least six bytes, a face at least two.
        const std::uint64_t bytes = in_.remaining().size() + 1;
        if (vertices > bytes / 6 || faces > (bytes - 6 * vertices) / 2)
            in_.fail("the file is too short for " + pluralized(vertices, "vertex") + " and " +
                     pluralized(faces, "face"));
        resize(vertices);
        for (std::size_t v = 0; v < vertices; ++v) read_vertex(v);
        for (std::uint64_t f = 0; f < faces; ++f) read_face(vertices);
        in_.skip_to_content();
        add_counted(warnings_, in_.remaining().size(), "byte", " after the last face ignored");
        if (unknown_colors_)
            warnings_.push_back("colours of " + pluralized(unknown_colors_, "face") +
                                " ignored: they have neither three nor four numbers");
        if (!colored_faces_) content_.faces.colors.clear();
        Asset asset = polygon_asset(std::move(content_), {}, file_, std::move(warnings_));
        asset.precision = precision_;
        return asset;
    }

private:
    std::uint64_t count(const char* element) {
        if (!in_.skip_to_content()) in_.fail(std::string("the number of ") + element + " is missing");
        const auto value = in_.number<std::uint64_t>();
        check_index_count(value, in_.file(), element);
        return value;
    }

    void resize(std::size_t vertices) {
        part_.positions.resize(vertices);
        if (keyword_.normals) part_.normals.resize(vertices);
        if (keyword_.colors) part_.colors.resize(vertices);
        if (keyword_.uvs) part_.uvs.emplace_back(vertices);
    }

    void read_vertex(std::size_t v) {
        if (!in_.skip_to_content()) in_.fail("the file ends before vertex " + std::to_string(v));
        for (double& x : part_.positions[v]) x = read_coordinate(in_, precision_);
        if (keyword_.normals)
            for (float& x : part_.normals[v]) x = in_.number<float>();
        if (keyword_.colors) read_color(part_.colors[v]);
        if (keyword_.uvs) {
            const auto s = in_.number<float>();
            part_.uvs[0][v] = {s, 1 - in_.number<float>()};
        }
        in_.finish_line();
    }

    void read_color(Vec4f& color) {
        ColorWords words;
        while (words.size < 4 && !at_color_end()) read_component(words);
        if (words.size < 3) in_.fail("a colour must have three or four components");
        color = words.linear();
    }

    void read_component(ColorWords& words) {
        const std::string_view before = in_.remaining();
        const auto value = in_.number<double>();
        const std::string_view word = before.substr(0, before.size() - in_.remaining().size());
        words.integers &= word.find_first_of(".eE") == std::string_view::npos;
        if (words.size < 4) words.rgba[words.size] = value;
        ++words.size;
    }

    /// Whether the colour ends here: at the end of the line or, if the file has UVs, before its last two
    /// words.
    bool at_color_end() {
        if (!keyword_.uvs) return in_.at_line_end();
        TextScanner ahead = in_;
        for (int i = 0; i < 2; ++i) {
            if (ahead.at_line_end()) return true;
            ahead.word();
        }
        return ahead.at_line_end();
    }

    void read_face(std::uint64_t vertices) {
        const std::size_t face = polygons_.sizes.size();
        if (!in_.skip_to_content()) in_.fail("the file ends before face " + std::to_string(face));
        const auto size = in_.number<std::uint32_t>();
        if (size > in_.remaining().size() / 2 + 1)
            in_.fail("the file is too short for " + pluralized(size, "corner"));
        for (std::uint32_t i = 0; i < size; ++i) {
            const auto v = in_.number<std::int64_t>();
            if (v < 0 || static_cast<std::uint64_t>(v) >= vertices)
                in_.fail("face " + std::to_string(face) + ": vertex " + std::to_string(v) +
                         " is out of range: there are " + std::to_string(vertices));
            polygons_.vertices.push_back(static_cast<Index>(v));
        }
        polygons_.sizes.push_back(size);
        ColorWords words;
        while (!in_.at_line_end()) read_component(words);
        in_.finish_line();
        const bool is_color = words.size == 3 || words.size == 4;
        colored_faces_ += is_color;
        unknown_colors_ += words.size > 0 && !is_color;
        content_.faces.colors.push_back(is_color ? words.linear() : Vec4f{1, 1, 1, 1});
    }

    TextScanner in_;
    const std::filesystem::path& file_;
    std::vector<std::string> warnings_;
    StoredPrecision precision_;
    Keyword keyword_;
    PolygonContent content_;
    Part& part_ = content_.part;
    Polygons& polygons_ = content_.faces.polygons;
    std::uint64_t colored_faces_ = 0, unknown_colors_ = 0;
};

}  // namespace

Asset read_off(std::span<const std::uint8_t> text, const std::filesystem::path& file) {
    return OffReader(text, file).run();
}

}  // namespace faqem::detail
