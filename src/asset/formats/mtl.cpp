#include "asset/formats/mtl.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "asset/image/srgb.hpp"
#include "asset/io/file.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/detail/base/lower_case.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Iterates over the words of a statement after its keyword.
class Words {
public:
    explicit Words(std::string_view text) : text_(text) {}
    std::string_view rest() const { return text_; }
    std::string_view peek() const {
        return text_.substr(0, std::min(text_.find_first_of(" \t"), text_.size()));
    }
    void skip() {
        text_.remove_prefix(peek().size());
        text_.remove_prefix(std::min(text_.find_first_not_of(" \t"), text_.size()));
    }
    bool is_last() const { return peek().size() == text_.size(); }

private:
    std::string_view text_;
};

std::optional<float> as_number(std::string_view word) {
    float value = 0;
    const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || last != word.data() + word.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

/// Where the options of a texture statement are. Before the file name its word, the last one, is not an argument,
/// even if it looks like a number.
enum class OptionPlace { before_name, after_name };

ScalarChannel scalar_channel(std::string_view letter) {
    static constexpr std::string_view letters = "rgbm";
    const std::size_t k = letter.size() == 1 ? letters.find(letter[0]) : std::string_view::npos;
    return k == std::string_view::npos
               ? ScalarChannel::luminance
               : static_cast<ScalarChannel>(static_cast<std::size_t>(ScalarChannel::red) + k);
}

/// Applies an option with one argument. Returns whether the argument fits the option.
bool apply_option(std::string_view option, std::string_view argument, MtlTexture& texture) {
    const bool is_switch = argument == "on" || argument == "off";
    if (option == "-clamp") texture.wrap = argument == "on" ? Wrap::clamp : Wrap::repeat;
    if (option == "-imfchan") texture.channel = scalar_channel(argument);
    if (option == "-bm") texture.multiplier = as_number(argument).value_or(texture.multiplier);
    if (option == "-bm" || option == "-boost" || option == "-texres") return as_number(argument).has_value();
    if (option == "-imfchan") return argument.size() == 1;
    return option == "-type" || is_switch;
}

/// Reads an option with its arguments. Returns false if there is none, or, after the name, if its arguments do not
/// fit it.
bool read_option(Words& words, OptionPlace place, MtlTexture& texture, IgnoredStatements& ignored) {
    static constexpr std::array<std::string_view, 9> one_argument = {
        "-blendu", "-blendv", "-boost", "-bm", "-cc", "-clamp", "-imfchan", "-texres", "-type"};
    const auto is_done = [&] {
        return place == OptionPlace::before_name ? words.is_last() : words.rest().empty();
    };
    static constexpr std::array<std::string_view, 5> used = {"-bm", "-clamp", "-imfchan", "-o", "-s"};
    const std::string_view option = words.peek();
    const bool takes_one = std::ranges::find(one_argument, option) != one_argument.end();
    const bool takes_pair = option == "-o" || option == "-s" || option == "-t";
    if ((!takes_one && !takes_pair && option != "-mm") || is_done()) return false;
    words.skip();
    bool fits = !is_done();
    if (takes_one && fits) {
        fits = apply_option(option, words.peek(), texture);
        words.skip();
    }
    Vec2f unused = {0, 0};
    Vec2f& pair = option == "-o" ? texture.offset : option == "-s" ? texture.scale : unused;
    for (std::size_t i = 0; takes_pair && i < 3 && !is_done(); ++i) {
        const std::optional<float> value = as_number(words.peek());
        if (!value) {
            fits = fits && i > 0;
            break;
        }
        if (i < 2) pair[i] = *value;
        words.skip();
    }
    for (int i = 0; option == "-mm" && i < 2 && !is_done(); ++i) words.skip();
    if (std::ranges::find(used, option) == used.end()) ++ignored["option " + TextScanner::quoted(option)];
    return fits || place == OptionPlace::before_name;
}

/// Removes options after the file name. A name that contains a blank and a minus is kept unless all that follows are
/// options.
void read_trailing_options(MtlTexture& texture, IgnoredStatements& ignored) {
    for (std::size_t at = 0; (at = texture.file.find(" -", at)) != std::string::npos; ++at) {
        const std::string_view name = std::string_view(texture.file).substr(0, at);
        const std::size_t end = name.find_last_not_of(" \t");
        if (end == std::string_view::npos) continue;
        MtlTexture with_options = texture;
        IgnoredStatements ignored_options = ignored;
        Words words(std::string_view(texture.file).substr(at + 1));
        bool are_options = true;
        while (are_options && !words.rest().empty())
            are_options = read_option(words, OptionPlace::after_name, with_options, ignored_options);
        if (!are_options) continue;
        with_options.file = name.substr(0, end + 1);
        texture = std::move(with_options);
        ignored = std::move(ignored_options);
        return;
    }
}

MtlTexture read_texture(const std::string& statement, IgnoredStatements& ignored) {
    MtlTexture texture;
    Words words(statement);
    while (read_option(words, OptionPlace::before_name, texture, ignored)) {
    }
    texture.file = words.rest();
    read_trailing_options(texture, ignored);
    return texture;
}

/// Parser of a material library.
class MtlReader {
public:
    MtlReader(std::span<const std::uint8_t> text, const std::string& name, std::vector<std::string>& warnings,
              IgnoredStatements& ignored)
        : in_(text, name, Continuation::yes), warnings_(warnings), ignored_(ignored) {}

    std::vector<MtlMaterial> run() {
        while (in_.skip_to_content()) {
            statement(in_.word());
            in_.next_line();
        }
        finish_material();
        for (const auto& [key, count] : unused_)
            warn(key + " is not supported (" + pluralized(count, "statement") + ")");
        return std::move(materials_);
    }

private:
    void warn(const std::string& what) { warnings_.push_back(in_.file() + ": " + what); }

    void statement(std::string_view key_as_written) {
        const std::string key = lower_case(std::string(key_as_written));
        if (key == "newmtl") {
            finish_material();
            materials_.emplace_back();
            materials_.back().values.name = in_.rest_of_line();
            materials_.back().values.metallic = 0;
        } else if (materials_.empty() || !read_known_statement(key, materials_.back())) {
            static constexpr std::array<std::string_view, 7> ignored_keys = {"ka", "ks",    "ni",       "tf",
                                                                             "km", "illum", "sharpness"};
            const bool is_ignored = std::ranges::find(ignored_keys, key) != ignored_keys.end();
            ++(is_ignored ? ignored_ : unused_)[TextScanner::quoted(key_as_written)];
        }
    }

    bool read_known_statement(std::string_view key, MtlMaterial& material) {
        if (key == "kd")
            diffuse_ = color();
        else if (key == "ke")
            emission_ = color();
        else if (key == "d")
            opacity_ = opacity();
        else if (key == "tr")
            transparency_ = unit_number();
        else if (key == "ns")
            exponent_ = in_.number<double>();
        else if (key == "pr")
            roughness_ = unit_number();
        else if (key == "pm")
            material.values.metallic = static_cast<float>(unit_number());
        else if (MtlTexture* texture = texture_of(key, material))
            *texture = read_texture(in_.rest_of_line(), ignored_);
        else
            return false;
        return true;
    }

    MtlTexture* texture_of(std::string_view key, MtlMaterial& material) {
        if (key == "map_kd") return &material.color;
        if (key == "map_ka") return &ambient_;
        if (key == "map_ke") return &material.emissive;
        if (key == "map_d") return &material.alpha;
        if (key == "norm") return &material.normal;
        if (key == "bump" || key == "map_bump") return &material.bump;
        if (key == "map_pr") return &material.roughness;
        if (key == "map_pm") return &material.metallic;
        return nullptr;
    }

    double unit_number() {
        const double value = in_.number<double>();
        if (value >= 0 && value <= 1) return value;
        warn("line " + std::to_string(in_.line()) + ": a number outside [0, 1] was clamped");
        return value <= 0 ? 0 : 1;
    }

    double opacity() {
        in_.accept_word("-halo");
        return unit_number();
    }

    /// Reads an RGB colour. A single number is a grey value.
    std::optional<Vec3> color() {
        if (in_.accept_word("spectral") || in_.accept_word("xyz")) {
            warn("line " + std::to_string(in_.line()) + ": only RGB colours are supported");
            return std::nullopt;
        }
        Vec3 rgb;
        rgb[0] = rgb[1] = rgb[2] = unit_number();
        for (int k = 1; k < 3 && !in_.at_line_end(); ++k) rgb[k] = unit_number();
        return rgb;
    }

    void finish_material() {
        if (materials_.empty()) return;
        MtlMaterial& material = materials_.back();
        if (material.color.file.empty() && !ambient_.file.empty()) {
            warn("material '" + material.values.name + "': map_Ka is read as the missing map_Kd");
            material.color = ambient_;
        } else if (!ambient_.file.empty()) {
            ++ignored_["'map_Ka'"];
        }
        const auto is_black = [](const Vec3& c) { return c == Vec3{0, 0, 0}; };
        if (diffuse_ && is_black(*diffuse_) && !material.color.file.empty()) {
            warn("material '" + material.values.name + "': Kd 0 0 0 with a map_Kd is read as 1 1 1");
            diffuse_.reset();
        }
        if (emission_ && is_black(*emission_) && !material.emissive.file.empty()) emission_.reset();
        Material& values = material.values;
        const double default_emission = material.emissive.file.empty() ? 0 : 1;
        for (int k = 0; k < 3; ++k) {
            values.base_color[k] = static_cast<float>(linear_from_srgb(diffuse_ ? (*diffuse_)[k] : 1));
            values.emissive[k] =
                static_cast<float>(linear_from_srgb(emission_ ? (*emission_)[k] : default_emission));
        }
        double alpha = opacity_ ? *opacity_ : transparency_ ? 1 - *transparency_ : 1;
        if (alpha <= 0) {
            warn("material '" + material.values.name + "': " + (opacity_ ? "d 0" : "Tr 1") +
                 " would hide everything, and is read as opaque");
            alpha = 1;
        }
        values.base_color[3] = static_cast<float>(alpha);
        if (alpha < 1) values.alpha_mode = AlphaMode::blend;
        if (roughness_)
            values.roughness = static_cast<float>(*roughness_);
        else if (exponent_ && *exponent_ > 0)
            values.roughness = static_cast<float>(std::sqrt(std::sqrt(2 / (*exponent_ + 2))));
        diffuse_.reset();
        emission_.reset();
        ambient_ = {};
        for (auto* number : {&opacity_, &transparency_, &exponent_, &roughness_}) number->reset();
    }

    TextScanner in_;
    std::vector<std::string>& warnings_;
    IgnoredStatements& ignored_;
    std::vector<MtlMaterial> materials_;
    std::map<std::string, std::uint64_t> unused_;
    // Values of the current material.
    std::optional<Vec3> diffuse_, emission_;
    MtlTexture ambient_;
    std::optional<double> opacity_, transparency_, exponent_, roughness_;
};

bool is_texture_key(std::string_view key) {
    static constexpr std::array<std::string_view, 5> others = {"bump", "disp", "decal", "refl", "norm"};
    const std::string lower = lower_case(std::string(key));
    return lower.starts_with("map_") || std::ranges::find(others, lower) != others.end();
}

/// Returns the only library in the folder of a model, unless that has the name of another OBJ file there.
std::optional<std::string> renamed_library(const fs::path& model, FileFinder& finder) {
    const std::vector<std::string> all = finder.files_with_extension(library_file_name(""));
    if (all.size() != 1) return std::nullopt;
    const fs::path own = model.filename();
    for (const std::string& other : finder.files_with_extension(lower_case_extension(own)))
        if (fs::path(other) != own && fs::path(other).stem() == fs::path(all[0]).stem()) return std::nullopt;
    return all[0];
}

}  // namespace

std::vector<std::string> texture_statements(std::span<const std::uint8_t> text, const std::string& name) {
    std::vector<std::string> statements;
    for (TextScanner in(text, name, Continuation::yes); in.skip_to_content(); in.next_line())
        if (is_texture_key(in.word())) statements.push_back(in.rest_of_line());
    return statements;
}

std::vector<MtlMaterial> read_mtl(std::span<const std::uint8_t> text, const std::string& name,
                                  std::vector<std::string>& warnings, IgnoredStatements& ignored) {
    return MtlReader(text, name, warnings, ignored).run();
}

std::vector<std::string> library_names(const std::string& statement, const fs::path& folder) {
    try {
        resolve_inside(folder, statement, ReferenceSyntax::file_name);
        return {statement};
    } catch (const InputError&) {
        std::vector<std::string> names;
        std::size_t first = 0;
        for (std::size_t end; (end = statement.find(".mtl ", first)) != std::string::npos; first = end + 5)
            names.push_back(statement.substr(first, end + 4 - first));
        names.push_back(statement.substr(first));
        return names;
    }
}

FoundFile find_library(const std::string& name, const fs::path& model, FileFinder& finder) {
    try {
        return finder.find(name);
    } catch (const InputError&) {
        const std::optional<std::string> other = renamed_library(model, finder);
        if (!other) throw;
        FoundFile found = finder.find(*other);
        found.is_as_named = false;
        return found;
    }
}

std::map<std::string, MtlMaterial> read_libraries(const std::vector<std::string>& statements,
                                                  const fs::path& model, FileFinder& finder,
                                                  std::vector<std::string>& warnings,
                                                  IgnoredStatements& ignored) {
    std::map<std::string, MtlMaterial> materials;
    std::set<std::string> known_names;
    std::set<fs::path> known_files;
    const auto read = [&](const std::string& name) {
        FoundFile found;
        std::vector<std::uint8_t> text;
        try {
            found = find_library(name, model, finder);
            if (!known_files.insert(found.file).second) return;
            text = read_file(found.file);
        } catch (const InputError& error) {
            return warnings.push_back(std::string("material library ignored: ") + error.what());
        }
        if (!found.is_as_named)
            warnings.push_back("material library " + TextScanner::quoted(name) + " was not found; the file " +
                               TextScanner::quoted(found.name) + " is read");
        for (MtlMaterial& material : read_mtl(text, found.file.string(), warnings, ignored)) {
            material.folder = fs::path(found.name).parent_path();
            materials[material.values.name] = std::move(material);
        }
    };
    for (const std::string& statement : statements)
        for (const std::string& name : library_names(statement, finder.folder()))
            if (known_names.insert(name).second) read(name);
    return materials;
}

}  // namespace faqem::detail
