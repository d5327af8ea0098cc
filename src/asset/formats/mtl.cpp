#include "asset/formats/mtl.hpp"

#include "asset/scene/messages.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>

#include "asset/image/image.hpp"
#include "asset/image/srgb.hpp"
#include "asset/io/file.hpp"
#include "asset/scene/repair.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

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

/// Reads up to three numbers and stores the first two. The last word is never read, since it is the file
/// name, which may look like a number.
void read_pair(Words& words, Vec2f& pair) {
    for (std::size_t i = 0; i < 3 && !words.is_last(); ++i) {
        const std::optional<float> value = as_number(words.peek());
        if (!value) return;
        if (i < 2) pair[i] = *value;
        words.skip();
    }
}

MtlTexture read_texture(const std::string& statement) {
    static constexpr std::array<std::string_view, 9> one_argument = {
        "-blendu", "-blendv", "-boost", "-bm", "-cc", "-clamp", "-imfchan", "-texres", "-type"};
    MtlTexture texture;
    for (Words words(statement);;) {
        const std::string_view option = words.peek();
        const bool takes_one =
            std::find(one_argument.begin(), one_argument.end(), option) != one_argument.end();
        const bool takes_pair = option == "-o" || option == "-s" || option == "-t";
        if ((!takes_one && !takes_pair && option != "-mm") || words.is_last()) {
            texture.file = words.rest();
            return texture;
        }
        words.skip();
        if (option == "-clamp") texture.wrap = words.peek() == "on" ? Wrap::clamp : Wrap::repeat;
        if (takes_one && !words.is_last()) words.skip();
        Vec2f unused = {0, 0};
        if (takes_pair)
            read_pair(words, option == "-o" ? texture.offset : option == "-s" ? texture.scale : unused);
        for (int i = 0; option == "-mm" && i < 2 && !words.is_last(); ++i) words.skip();
    }
}

/// Parser of a material library.
class MtlReader {
public:
    MtlReader(std::span<const std::uint8_t> text, const std::string& name, std::vector<std::string>& warnings)
        : in_(text, name, Continuation::yes), warnings_(warnings) {}

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

    void statement(std::string_view key) {
        if (key == "newmtl") {
            finish_material();
            materials_.emplace_back();
            materials_.back().name = in_.rest_of_line();
            materials_.back().values.name = materials_.back().name;
            materials_.back().values.metallic = 0;
        } else if (materials_.empty() || !read_known_statement(key, materials_.back())) {
            static constexpr std::array<std::string_view, 8> ignored_keys = {
                "Ka", "Ks", "Ni", "Tf", "Km", "map_Ka", "illum", "sharpness"};
            if (std::find(ignored_keys.begin(), ignored_keys.end(), key) == ignored_keys.end())
                ++unused_[TextScanner::quoted(key)];
        }
    }

    bool read_known_statement(std::string_view key, MtlMaterial& material) {
        if (key == "Kd")
            diffuse_ = color();
        else if (key == "Ke")
            emission_ = color();
        else if (key == "d")
            opacity_ = opacity();
        else if (key == "Tr")
            transparency_ = unit_number();
        else if (key == "Ns")
            exponent_ = in_.number<double>();
        else if (key == "Pr")
            roughness_ = unit_number();
        else if (key == "Pm")
            material.values.metallic = static_cast<float>(unit_number());
        else if (key == "map_Kd")
            material.color = read_texture(in_.rest_of_line());
        else if (key == "map_Ke")
            material.emissive = read_texture(in_.rest_of_line());
        else if (key == "map_d")
            material.alpha = read_texture(in_.rest_of_line());
        else if (key == "norm")
            material.normal = read_texture(in_.rest_of_line());
        else
            return false;
        return true;
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
        const auto is_black = [](const Vec3& c) { return c == Vec3{0, 0, 0}; };
        if (diffuse_ && is_black(*diffuse_) && !material.color.file.empty()) {
            warn("material '" + material.name + "': Kd 0 0 0 with a map_Kd is read as 1 1 1");
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
            warn("material '" + material.name + "': " + (opacity_ ? "d 0" : "Tr 1") +
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
        for (auto* number : {&opacity_, &transparency_, &exponent_, &roughness_}) number->reset();
    }

    TextScanner in_;
    std::vector<std::string>& warnings_;
    std::vector<MtlMaterial> materials_;
    std::map<std::string, std::uint64_t> unused_;
    // Values of the current material.
    std::optional<Vec3> diffuse_, emission_;
    std::optional<double> opacity_, transparency_, exponent_, roughness_;
};

/// Returns the index of an image, which is read unless the asset already has it; no_index with a warning if
/// it cannot be read.
Index add_image(Asset& asset, const MtlMaterial& material, const std::string& name,
                const std::filesystem::path& folder) {
    try {
        const std::string reference = (material.folder / name).generic_string();
        const std::filesystem::path found = resolve_inside(folder, reference, ReferenceSyntax::file_name);
        const std::filesystem::path root = std::filesystem::canonical(folder.empty() ? "." : folder);
        Image image;
        image.uri = found.lexically_relative(root).generic_string();
        for (Index i = 0; i < asset.images.size(); ++i)
            if (asset.images[i].uri == image.uri) return i;
        image.name = found.stem().string();
        image.encoded = read_file(found);
        image.mime_type = sniff_mime_type(image.encoded);
        asset.images.push_back(std::move(image));
        return static_cast<Index>(asset.images.size() - 1);
    } catch (const InputError& error) {
        asset.warnings.push_back("material '" + material.name + "': texture left out: " + error.what());
        return no_index;
    }
}

TextureRef add_texture(Asset& asset, const MtlMaterial& material, const MtlTexture& texture,
                       const std::filesystem::path& folder) {
    TextureRef ref;
    if (texture.file.empty()) return ref;
    ref.image = add_image(asset, material, texture.file, folder);
    ref.wrap_u = ref.wrap_v = texture.wrap;
    ref.scale = texture.scale;
    // MTL defines v' = o + s * v with v pointing up. With v = 1 - w this becomes w' = (1 - s - o) + s * w.
    ref.offset = {texture.offset[0], 1 - texture.scale[1] - texture.offset[1]};
    return ref;
}

bool is_texture_key(std::string_view key) {
    static constexpr std::array<std::string_view, 5> others = {"bump", "disp", "decal", "refl", "norm"};
    std::string lower(key);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower.starts_with("map_") || std::find(others.begin(), others.end(), lower) != others.end();
}

}  // namespace

std::vector<std::string> texture_statements(std::span<const std::uint8_t> text, const std::string& name) {
    std::vector<std::string> statements;
    for (TextScanner in(text, name, Continuation::yes); in.skip_to_content(); in.next_line())
        if (is_texture_key(in.word())) statements.push_back(in.rest_of_line());
    return statements;
}

std::vector<MtlMaterial> read_mtl(std::span<const std::uint8_t> text, const std::string& name,
                                  std::vector<std::string>& warnings) {
    return MtlReader(text, name, warnings).run();
}

Index add_material(Asset& asset, const MtlMaterial& source, const std::filesystem::path& folder) {
    Material material = source.values;
    material.base_color_texture = add_texture(asset, source, source.color, folder);
    material.emissive_texture = add_texture(asset, source, source.emissive, folder);
    material.normal_texture = add_texture(asset, source, source.normal, folder);
    if (!source.alpha.file.empty()) {
        if (material.base_color_texture && source.alpha.file == source.color.file)
            material.alpha_mode = AlphaMode::blend;
        else
            asset.warnings.push_back("material '" + source.name +
                                     "': map_d is supported only if it is the same image as map_Kd");
    }
    asset.materials.push_back(std::move(material));
    return static_cast<Index>(asset.materials.size() - 1);
}

}  // namespace faqem::detail
