#include "cli/options/profile.hpp"

#include "cli/commands/command_line.hpp"
#include "cli/options/builtin_profiles.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace faqem::cli;
using namespace tool_test;
using Words = std::vector<std::string>;

namespace {

/// Returns the words that a profile adds to a command line.
Words added(const std::string& profile, Words words = {"simplify", "a", "b"}) {
    const Folder folder;
    write(folder / "p.json", profile);
    words.push_back("--config=" + (folder / "p.json").string());
    const Words all = expand_profile(command_tree(), words);
    CHECK(Words(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(words.size())) == words);
    return {all.begin() + static_cast<std::ptrdiff_t>(words.size()), all.end()};
}

std::string usage_error(const std::string& profile, const std::string& command = "simplify") {
    const Folder folder;
    write(folder / "p.json", profile);
    write(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Outcome outcome = run(folder, command + " a.obj b --config p.json");
    CHECK(outcome.code == 2);
    return outcome.err;
}

}  // namespace

TEST_CASE("numbers, strings, flags and lists of a profile are converted to options") {
    CHECK(
        added(
            R"({"faqem-profile": 1, "ratio": 0.25, "preset": "fast", "link": true, "keep-groups": false})") ==
        Words{"--ratio=0.25", "--preset=fast", "--link"});
    CHECK(added(R"({"faqem-profile": 1, "faces": 5000, "max-error": "0.1%"})") ==
          Words{"--faces=5000", "--max-error=0.1%"});
    CHECK(added(R"({"faqem-profile": 1, "virtual-edges": 0.02})") == Words{"--virtual-edges=0.02"});
    CHECK(added(R"({"faqem-profile": 1, "levels": [0.5, 5000, "error:1%"]})", {"lod", "a", "b"}) ==
          Words{"--levels=0.5,5000,error:1%"});
}

TEST_CASE("the command line takes precedence over the profile, also for options that exclude each other") {
    const std::string profile = R"({"faqem-profile": 1, "ratio": 0.25, "preset": "fast"})";
    CHECK(added(profile, {"simplify", "a", "b", "--ratio", "0.5"}) == Words{"--preset=fast"});
    CHECK(added(profile, {"simplify", "a", "b", "--ratio=0.5"}) == Words{"--preset=fast"});
    for (const char* letters : {"-r.5", "-r", "-fr.5", "-qfr"})
        CHECK(added(profile, {"simplify", "a", "b", letters}) == Words{"--preset=fast"});
    for (const char* letters : {"-f", "-or.glb", "-", "-fq"})  // r is a letter of a file name, or missing
        CHECK(added(profile, {"simplify", "a", letters}) == Words{"--ratio=0.25", "--preset=fast"});
    CHECK(added(profile, {"simplify", "a", "b", "--faces", "7"}) == Words{"--preset=fast"});
    CHECK(added(profile, {"batch", "a", "b", "--preset", "qem"}) == Words{"--ratio=0.25"});
}

TEST_CASE("the command line is unchanged without a profile") {
    for (const Words& words : {Words{}, Words{"simplify", "a", "b"}, Words{"info", "--config=p"},
                               Words{"simplify", "a", "--", "--config=p"}, Words{"simplify", "--config"}}) {
        CHECK(expand_profile(command_tree(), words) == words);
    }
}

TEST_CASE("a profile gives the same result as its options on the command line") {
    const Folder folder;
    faqem::save(sheet(8), folder / "in.glb");
    write(folder / "p.json", R"({"faqem-profile": 1, "faces": 30, "bake": "none", "quiet": true})");
    REQUIRE(run(folder, "simplify in.glb by-profile.glb --config p.json").out.empty());
    REQUIRE(run(folder, "simplify in.glb by-options.glb --faces 30 --bake none --quiet").code == 0);
    CHECK(read(folder / "by-profile.glb") == read(folder / "by-options.glb"));
    REQUIRE(run(folder, "simplify in.glb overridden.glb --config p.json --faces 60").code == 0);
    CHECK(faqem::load(folder / "overridden.glb").parts[0].triangles.size() > 30);
}

TEST_CASE("an unknown key of a profile is a usage error with a suggestion") {
    const std::string wrong = usage_error(R"({"faqem-profile": 1, "ration": 0.5})");
    CHECK(wrong == "faqem: p.json: 'ration' is not an option of faqem simplify; did you mean 'ratio'?\n");
    CHECK(usage_error(R"({"faqem-profile": 1, "levels": [0.5]})") ==
          "faqem: p.json: 'levels' is not an option of faqem simplify, but of faqem lod\n");
    CHECK(usage_error(R"({"faqem-profile": 1, "config": "other.json"})").find("'config' is not an option") !=
          std::string::npos);
}

TEST_CASE("values of the wrong type and other versions of the profile are usage errors") {
    CHECK(usage_error(R"({"faqem-profile": 1, "link": 1})") ==
          "faqem: p.json: link: must be true or false\n");
    CHECK(usage_error(R"({"faqem-profile": 1, "quantize": true})") ==
          "faqem: p.json: quantize: must be a number or a string\n");
    CHECK(usage_error(R"({"faqem-profile": 1, "ratio": true})") ==
          "faqem: p.json: ratio: must be a number or a string\n");
    CHECK(usage_error(R"({"faqem-profile": 1, "ratio": null})").find("must be a number") !=
          std::string::npos);
    CHECK(usage_error(R"({"faqem-profile": 1, "ratio": "much"})").find("--ratio") != std::string::npos);
    CHECK(usage_error(R"({"ratio": 0.5})") ==
          "faqem: p.json: is not a profile: \"faqem-profile\": 1 is missing\n");
    CHECK(usage_error(R"({"faqem-profile": 2})") ==
          "faqem: p.json: faqem-profile: version 2 is not supported, only version 1\n");
}

TEST_CASE("a profile that is missing or not a JSON object is bad input") {
    const Folder folder;
    write(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(run(folder, "simplify a.obj b.obj --config missing.json").code == 3);
    for (const char* text : {"", "{", "[1]", "{\"faqem-profile\": 1, \"faces\": 5, \"faces\": 6}"}) {
        CAPTURE(text);
        write(folder / "p.json", text);
        const Outcome outcome = run(folder, "simplify a.obj b.obj --config p.json");
        CHECK(outcome.code == 3);
        CHECK(outcome.err.find("faqem: p.json: ") == 0);
    }
}

TEST_CASE("the options of a built-in profile come last, and a file before them") {
    const auto expanded = [](Words words) {
        const std::size_t given = words.size();
        const Words all = expand_profile(command_tree(), std::move(words));
        return Words(all.begin() + static_cast<std::ptrdiff_t>(given), all.end());
    };
    const Words web = {"--image-format=webp", "--image-quality=34", "--compress=meshopt", "--quantize=on"};
    CHECK(expanded({"simplify", "a", "b", "--profile", "web"}) == web);
    CHECK(expanded({"lod", "a", "b", "--profile=web"}) == web);
    CHECK(expanded({"batch", "a", "b", "--compress", "none", "--profile", "web"}) ==
          Words{"--image-format=webp", "--image-quality=34", "--quantize=on"});
    CHECK(expanded({"simplify", "a", "b", "--profile", "game", "--quantize", "on"}) ==
          Words{"--image-format=png-or-jpeg", "--compress=none"});
    CHECK(expanded({"info", "--profile=web"}).empty());
    CHECK(added(R"({"faqem-profile": 1, "compress": "none", "quantize": "source"})",
                {"simplify", "a", "b", "--profile", "web"}) ==
          Words{"--compress=none", "--quantize=source", "--image-format=webp", "--image-quality=34"});
    CHECK_THROWS_AS(expanded({"simplify", "a", "b", "--profile", "print"}), faqem::OptionError);
}

TEST_CASE("a built-in profile that is printed is a file with the same options") {
    for (const BuiltinProfile& profile : builtin_profiles()) {
        const Words from_file = added(profile_file(profile));
        const Words all =
            expand_profile(command_tree(), {"simplify", "a", "b", "--profile", std::string(profile.name)});
        CHECK(Words(all.begin() + 5, all.end()) == from_file);
        CHECK(profile_list().find(std::string(profile.name) + ": ") != std::string::npos);
    }
}
