// Options that are given and have no effect on the result.

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

/// The options that are named as having no effect, with a space after each.
std::string idle_options(const std::string& text) {
    std::string names;
    const std::string what = " has no effect: ";
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) {
        const std::size_t begin = text.find_last_of(" \n\"", at - 1) + 1;
        names += text.substr(begin, at - begin) + " ";
    }
    return names;
}

}  // namespace

TEST_CASE("a typed option without effect gives a warning that says why") {
    const ModelFolder folder("in.glb", sheet(8));
    faqem::save(sheet(8), folder / "bare.stl");
    const auto idle = [&](const std::string& options) {
        const Outcome outcome = run(folder, "simplify " + options + " --force");
        CAPTURE(options, outcome.err);
        CHECK(outcome.code == 0);
        return idle_options(outcome.out);
    };
    const std::string keep = "in.glb out.glb --bake keep ", vertex = "in.glb out.glb --bake vertex ";
    CHECK(idle(keep + "--texture-size 64 --image-format png") == "--texture-size --image-format ");
    CHECK(idle(keep + "--texture-size 64 --max-bytes 1MB") == "");
    CHECK(idle(vertex + "--normal-map on --texel-density 2") == "--texel-density --normal-map ");
    CHECK(idle("in.glb out.glb --position-bits 12 --uv-bits 9") == "--position-bits --uv-bits ");
    CHECK(idle("in.glb out.glb --position-bits 12 --quantize on") == "");
    CHECK(idle("in.glb out.glb --uv-bits 9 --compress meshopt --quantize on") == "");
    CHECK(idle("in.glb out.glb --uv-bits 9 --compress none --quantize on") == "--uv-bits ");
    CHECK(idle("bare.stl out.stl --texture-size 64 --ratio 0.5 --preset fast") == "--texture-size ");
    const Outcome one = run(folder, "simplify " + keep + "--texture-size 64 -f");
    CHECK(one.out.find("  --texture-size has no effect: there is no new texture\n") != std::string::npos);
}

TEST_CASE("an option of a profile that has no effect gives no warning") {
    const ModelFolder folder("in.glb", sheet(8));
    write(folder / "p.json", R"({"faqem-profile": 1, "texture-size": 64, "position-bits": 12})");
    const std::string keep = "simplify in.glb out.glb --force --bake keep --config p.json ";
    CHECK(idle_options(run(folder, keep).out) == "");
    CHECK(idle_options(run(folder, keep + "--texture-size 128").out) == "--texture-size ");
    CHECK(idle_options(run(folder, "simplify in.glb out.obj -f --profile web --image-format png").out) == "");
}

TEST_CASE("the other commands warn, too, and a batch once") {
    const ModelFolder folder("in.glb", sheet(8));
    fs::create_directory(folder / "models");
    for (const char* name : {"models/a.glb", "models/b.glb"}) fs::copy_file(folder / "in.glb", folder / name);
    const std::string keep = " --bake keep --texture-size 64";
    CHECK(idle_options(run(folder, "lod in.glb out --levels 50 --history h.bin" + keep).out) ==
          "--texture-size ");
    const Outcome batch = run(folder, "batch models results" + keep);
    CHECK(idle_options(batch.err) == "--texture-size ");
    CHECK(idle_options(batch.out) == "");
    const std::string cut = "truncate h.bin cut.glb --force --faces 60 --texture-size 64";
    CHECK(idle_options(run(folder, cut).out) == "--texture-size ");
    CHECK(idle_options(run(folder, cut + " --source in.glb").out) == "");
}
