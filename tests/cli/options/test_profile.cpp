#include "cli/options/profile.hpp"

#include "cli/commands/command_line.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace faqem::cli;
using namespace tool_test;
using Words = std::vector<std::string>;

namespace {

/// The values that profiles add to those of a command, as words of a command line.
/// \param typed  names and values of options, as `--ratio`, `0.5`
Words added_values(const std::string& command, std::vector<std::pair<std::string, std::string>> typed) {
    const CommandTree tree = command_tree();
    const auto& commands = tree.commands;
    const CommandInfo& info = *std::find_if(commands.begin(), commands.end(),
                                            [&](const CommandInfo& c) { return c.name == command; });
    std::vector<ParsedValue> values;
    for (const auto& [name, value] : typed)
        for (const OptionInfo& option : info.options)
            if (option.names.back() == name) values.push_back({&option, {value}, true});
    REQUIRE(values.size() == typed.size());
    add_profile_values(tree, info, values);
    Words result;
    for (std::size_t i = typed.size(); i < values.size(); ++i) {
        CHECK_FALSE(values[i].is_typed);
        result.push_back(values[i].option->names.back());
        for (const std::string& word : values[i].words)
            result.back() += (&word == &values[i].words[0] ? "=" : ",") + word;
    }
    return result;
}

/// Those of a file.
Words added(const std::string& profile, const std::string& command = "simplify",
            std::vector<std::pair<std::string, std::string>> typed = {}) {
    const Folder folder;
    write(folder / "p.json", profile);
    typed.emplace_back("--config", (folder / "p.json").string());
    return added_values(command, std::move(typed));
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
        Words{"--ratio=0.25", "--preset=fast", "--link=true"});
    CHECK(added(R"({"faqem-profile": 1, "faces": 5000, "max-error": "0.1%"})") ==
          Words{"--faces=5000", "--max-error=0.1%"});
    CHECK(added(R"({"faqem-profile": 1, "virtual-edges": 0.02})") == Words{"--virtual-edges=0.02"});
    for (const char* levels : {R"([0.5, 5000, "error:1%"])", R"("0.5,5000,error:1%")"})
        CHECK(added(R"({"faqem-profile": 1, "levels": )" + std::string(levels) + "}", "lod") ==
              Words{"--levels=0.5,5000,error:1%"});
}

TEST_CASE("the command line takes precedence over the profile, also for options that exclude each other") {
    const std::string profile = R"({"faqem-profile": 1, "ratio": 0.25, "preset": "fast"})";
    CHECK(added(profile, "simplify", {{"--ratio", "0.5"}}) == Words{"--preset=fast"});
    CHECK(added(profile, "simplify", {{"--faces", "7"}}) == Words{"--preset=fast"});
    CHECK(added(profile, "batch", {{"--preset", "qem"}}) == Words{"--ratio=0.25"});
    CHECK(usage_error(R"({"faqem-profile": 1, "ratio": 0.25, "faces": 7})") ==
          "faqem: p.json: faces: cannot be used with ratio\n");
}

TEST_CASE("a profile gives the same result as its options on the command line") {
    const ModelFolder folder("in.glb", sheet(8));
    write(folder / "p.json", R"({"faqem-profile": 1, "faces": 30, "bake": "none", "quiet": true})");
    REQUIRE(run(folder, "simplify in.glb by-profile.glb --config p.json").out.empty());
    REQUIRE(run(folder, "simplify in.glb by-options.glb --faces 30 --bake none --quiet").code == 0);
    CHECK(read(folder / "by-profile.glb") == read(folder / "by-options.glb"));
    REQUIRE(run(folder, "simplify in.glb overridden.glb --config p.json -qr.5").code == 0);
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
    CHECK(usage_error(R"({"faqem-profile": 1, "ratio": [0.5]})").find("must be a number") !=
          std::string::npos);
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
    const Words web = {"--image-format=webp", "--image-quality=34", "--compress=meshopt", "--quantize=on"};
    CHECK(added_values("simplify", {{"--profile", "web"}}) == web);
    CHECK(added_values("lod", {{"--profile", "web"}}) == web);
    CHECK(added_values("batch", {{"--compress", "none"}, {"--profile", "web"}}) ==
          Words{"--image-format=webp", "--image-quality=34", "--quantize=on"});
    CHECK(added_values("simplify", {{"--profile", "game"}, {"--quantize", "on"}}) ==
          Words{"--image-format=png-or-jpeg", "--compress=none"});
    CHECK(added(R"({"faqem-profile": 1, "compress": "none", "quantize": "source"})", "simplify",
                {{"--profile", "web"}}) ==
          Words{"--compress=none", "--quantize=source", "--image-format=webp", "--image-quality=34"});
    CHECK_THROWS_AS(added_values("simplify", {{"--profile", "print"}}), faqem::OptionError);
}

TEST_CASE("a built-in profile that is printed is a file with the same options") {
    for (const std::string name : {"web", "game"}) {
        CHECK(added_values("simplify", {{"--profile", name}}) == added(profile_file(name)));
        CHECK(profile_list().find(name + ": ") != std::string::npos);
    }
}
