#include "faqem/detail/options/option_table.hpp"

#include <set>

#include "faqem/error.hpp"
#include "faqem/report.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

/// The error message of setting an option by its name, or "accepted".
std::string set_complaint(Options& options, std::string_view name, std::string_view text) {
    return testing::message_of<OptionError>(
        [&] { set_option(options, named_option(name), text, name_spelling); });
}

/// A valid text of each option that differs from its default.
std::string changed_text(const OptionRow& row) {
    if (row.kind == OptionKind::choice) {
        for (const std::string& word : split_choices(row.choices)) {
            if (word != option_text({}, row)) return word;
        }
    }
    for (const char* text : {"0.5", "7", "9", "50", "128"}) {
        try {
            Options options;
            set_option(options, row, text, name_spelling);
            if (option_text(options, row) != option_text({}, row)) return text;
        } catch (const OptionError&) {
        }
    }
    return "none";
}

}  // namespace

TEST_CASE("every row of the table has a unique name, a help text, and a value other than its default") {
    std::set<std::string_view> names;
    for (const OptionRow& row : option_table()) {
        CAPTURE(row.name);
        CHECK(names.insert(row.name).second);
        CHECK(!row.help.empty());
        CHECK((row.entry_points <= in_c_and_python || !row.value_name.empty() || !row.choices.empty()));
        Options options;
        set_option(options, row, changed_text(row), name_spelling);
        CHECK(option_text(options, row) != option_text({}, row));
        CHECK((options_key(options) != options_key({})) == row.affects_result);
        for (const OptionRow& other : option_table()) {
            const bool is_other_target = row.excludes == other.name;
            if (row.name != other.name && !is_other_target)
                CHECK(option_text(options, other) == option_text({}, other));
        }
    }
}

TEST_CASE("every member that affects the result changes the key of the options") {
    // If this does not compile, a member was added: it needs a row in the table, and a change here.
    std::set<std::string> keys = {options_key({})};
    const auto changes_key = [&keys](auto&& change) {
        Options options;
        change(options);
        return keys.insert(options_key(options)).second;
    };
    for (std::size_t k = 0; k < 16; ++k) {
        CHECK(changes_key([k](Options& o) {
            auto& [target, budget, visibility, max_error, max_seconds, preset, weights, topology, history,
                   format, larger, max_bytes, bake, compress, quantize, threads, progress] = o;
            if (k == 0) target = ratio(0.1);
            if (k == 1) target = faces(1);
            if (k == 2) budget = Budget::mesh;
            if (k == 3) visibility = Visibility::weighted;
            if (k == 4) max_error = model_units(0.1);
            if (k == 5) preset = Preset::fast;
            if (k == 6) history = Recording::on;
            if (k == 7) max_seconds = 60;
            if (k == 8) compress = Compression::meshopt;
            if (k == 13) format = ModelFormat::obj;
            if (k == 14) larger = LargerFiles::allowed;
            if (k == 15) max_bytes = 1000;
            auto& [kind, position_bits, normal_bits, uv_bits] = quantize;
            if (k == 9) kind = Quantize::on;
            if (k == 10) position_bits = 16;
            if (k == 11) normal_bits = 16;
            if (k == 12) uv_bits = 16;
        }));
    }
    CHECK(changes_key([](Options& o) { o.max_error = of_diagonal(0.1); }));
    CHECK(!changes_key([](Options& o) { o.threads = 3; }));
    for (std::size_t k = 0; k < 5; ++k) {
        CHECK(changes_key([k](Options& o) {
            auto& [area, boundary, normal, uv, plane_area] = o.weights;
            std::optional<double>* const all[] = {&area, &boundary, &normal, &uv, &plane_area};
            *all[k] = 0;
        }));
    }
    for (std::size_t k = 0; k < 8; ++k) {
        CHECK(changes_key([k](Options& o) {
            auto& [link, border, groups, weld, weld_distance, edges, edge_distance, prune] = o.topology;
            if (k == 0) link = LinkCondition::on;
            if (k == 1) border = Boundary::locked;
            if (k == 2) groups = GroupBoundaries::preserved;
            if (k == 3) weld = Weld::none;
            if (k == 4) weld_distance = 0;
            if (k == 5) edges = VirtualEdges::on;
            if (k == 6) edge_distance = 0.5;
            if (k == 7) prune = of_diagonal(0.1);
        }));
    }
    for (std::size_t k = 0; k < 12; ++k) {
        CHECK(changes_key([k](Options& o) {
            auto& [kind, size, density, normal_map, samples, normals, angle, format, image_quality, quality,
                   untouched, correspondence] = o.bake;
            if (k == 0) kind = Bake::keep;
            if (k == 1) size = 64;
            if (k == 2) density = 1;
            if (k == 3) normal_map = NormalMap::on;
            if (k == 4) untouched = UntouchedParts::baked;
            if (k == 5) samples = 3;
            if (k == 6) normals = Normals::flat;
            if (k == 7) angle = 30;
            if (k == 8) format = ImageFormat::jpeg;
            if (k == 9) quality = 80;
            if (k == 10) correspondence = Recording::on;
            if (k == 11) image_quality = 50;
        }));
    }
}

TEST_CASE("options are set from text, and errors name the option") {
    Options o;
    CHECK(set_complaint(o, "allow-larger", "on") == "accepted");
    CHECK(o.larger == LargerFiles::allowed);
    CHECK(set_complaint(o, "allow-larger", "off") == "accepted");
    CHECK(o.larger == LargerFiles::avoided);
    CHECK(set_complaint(o, "link", "off") == "accepted");  // a word of its own, not the default
    CHECK(o.topology.link == LinkCondition::off);
    CHECK(set_complaint(o, "texel-density", "1.5") == "accepted");
    CHECK(o.bake.texel_density == 1.5);
    CHECK(set_complaint(o, "texel-density", "9") == "texel-density must be in [0.125, 8], not 9");
    CHECK(set_complaint(o, "texel-density", "1.5x") == "texel-density: '1.5x' is not a number");
    CHECK(set_complaint(o, "texel-density", "") == "texel-density: '' is not a number");
    CHECK(set_complaint(o, "texel-density", "nan") == "texel-density must be in [0.125, 8], not nan");
    CHECK(o.bake.texel_density == 1.5);
    CHECK(set_complaint(o, "threads", "1.5") == "threads: '1.5' is not a whole number");
    CHECK(set_complaint(o, "threads", "-1") == "threads: '-1' is not a whole number");
    CHECK(set_complaint(o, "threads", "1025") == "threads must be in [0, 1024], not 1025");
    CHECK(set_complaint(o, "texture-size", "100") ==
          "texture-size must be a power of two in [64, 16384], not 100");
    CHECK(set_complaint(o, "weld-distance", "inf") == "weld-distance must be finite and >= 0, not inf");
    CHECK(set_complaint(o, "bake", "vertex") == "accepted");
    CHECK(o.bake.kind == Bake::vertex);
    CHECK(set_complaint(o, "normal-map", "maybe") ==
          "normal-map: unknown value 'maybe' (known: auto, on, off)");
    CHECK(set_complaint(o, "ratio", "12.5%") == "accepted");
    CHECK((o.target.kind == Target::Kind::ratio && o.target.value == 0.125));
    CHECK(set_complaint(o, "faces", "18446744073709551615") == "accepted");
    CHECK((o.target.kind == Target::Kind::faces && o.target.value == 0x1p64));
    CHECK(set_complaint(o, "faces", "0") == "faces must be >= 1, not 0");
    CHECK(set_complaint(o, "max-error", "1%") == "accepted");
    CHECK((o.max_error->unit == Length::Unit::diagonal && o.max_error->value == 0.01));
    CHECK(set_complaint(o, "max-error", "2") == "accepted");
    CHECK((o.max_error->unit == Length::Unit::model && o.max_error->value == 2));
    CHECK(set_complaint(o, "max-error", "%") == "max-error: '%' is not a number");
}

TEST_CASE("choices with a number set two options, and flags are on and off") {
    Options o;
    CHECK(set_complaint(o, "normals", "smooth:30") == "accepted");
    CHECK((o.bake.normals == Normals::smooth && o.bake.crease_angle == 30));
    CHECK(set_complaint(o, "normals", "smooth:200") == "crease-angle must be in [0, 180] degrees, not 200");
    CHECK(set_complaint(o, "normals", "flat:30").starts_with("normals: unknown value 'flat:30'"));
    CHECK(set_complaint(o, "image-format", "jpeg:50") == "accepted");
    CHECK((o.bake.image_format == ImageFormat::jpeg && o.bake.jpeg_quality == 50));
    CHECK(set_complaint(o, "virtual-edges", "on") == "accepted");
    CHECK((o.topology.virtual_edges == VirtualEdges::on && o.topology.virtual_edge_distance == 0.01));
    CHECK(set_complaint(o, "virtual-edges", "0.5") == "accepted");
    CHECK(o.topology.virtual_edge_distance == 0.5);
    CHECK(set_complaint(o, "virtual-edges", "off") == "accepted");
    CHECK(o.topology.virtual_edges == VirtualEdges::off);
}

TEST_CASE("an unknown option is an error with a suggestion") {
    Options o;
    CHECK(set_complaint(o, "texel-densty", "1") ==
          "unknown option 'texel-densty'; did you mean 'texel-density'?");
    CHECK(set_complaint(o, "lock-boundary", "on") ==
          "unknown option 'lock-boundary' (of the command); use boundary='locked'");
    CHECK(set_complaint(o, "weld", "1") == "unknown option 'weld' (of the command); use weld-distance");
    CHECK(set_complaint(o, "profile", "web") == "unknown option 'profile': only the command has it");
    CHECK(set_complaint(o, "frobnicate", "1") == "unknown option 'frobnicate'");
    CHECK(set_complaint(o, "", "1") == "unknown option ''");
}

TEST_CASE("presets have the names of the table") {
    const std::vector<std::string> words = split_choices(named_option("preset").choices);
    REQUIRE(words.size() == all_presets.size());
    for (std::size_t i = 0; i < words.size(); ++i) CHECK(words[i] == name(all_presets[i]));
}

TEST_CASE("validate rejects values that are not enumerators") {
    Options options;
    options.bake.normal_map = static_cast<NormalMap>(3);
    CHECK_THROWS_AS(validate(options), OptionError);
}
