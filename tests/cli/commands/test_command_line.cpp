#include <map>
#include <string>

#include "faqem/version.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

TEST_CASE("help and version are printed to stdout with exit code 0") {
    const Folder folder;
    for (const char* arguments :
         {"", "help", "help simplify", "-V", "--help", "--version", "simplify --help", "batch --help",
          "info --help", "compare --help", "render --help", "completion"}) {
        const Outcome outcome = run(folder, arguments);
        CHECK(outcome.code == 0);
        CHECK(!outcome.out.empty());
        CHECK(outcome.err.empty());
    }
    CHECK(run(folder, "--version").out == "faqem " + std::string(faqem::version()) + "\n");
}

TEST_CASE("an invalid command line exits with 2 and an error on stderr") {
    const ModelFolder folder("in.glb", sheet(4));
    for (const char* arguments : {"dance",
                                  "help dance",
                                  "in.glb out.glb -o other.glb",
                                  "simplify",
                                  "simplify in.glb",
                                  "simplify in.glb out.glb --frobnicate",
                                  "simplify in.glb out.glb --faces -3",
                                  "simplify in.glb out.glb --faces 10 --ratio 0.5",
                                  "simplify in.glb out.glb --preset bestest",
                                  "simplify in.glb out.glb --quantize",
                                  "simplify in.glb out.obj --image-format webp",
                                  "simplify in.glb out.glb --correspondence map.bin --bake vertex",
                                  "simplify in.glb out.glb --correspondence out.glb",
                                  "simplify in.glb out.glb --visibility weighted --max-error 1%",
                                  "simplify in.glb out.glb extra",
                                  "lod in.glb levels --ratios 0.5 --max-seconds 1",
                                  "info",
                                  "compare in.glb",
                                  "compare in.glb in.glb --samples 0",
                                  "render out.png",
                                  "render in.glb out.jpg",
                                  "render in.glb out.png --size 0"}) {
        CAPTURE(arguments);
        const Outcome outcome = run(folder, arguments);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(!outcome.err.empty());
        CHECK(!fs::exists(folder / "out.glb"));
    }
}

TEST_CASE("messages about values out of range name the option of the command") {
    const ModelFolder folder("a.glb", sheet(2));
    const std::pair<const char*, const char*> wrong[] = {
        {"--ratio", "2"},           {"--faces", "0"},          {"--max-error", "0"},
        {"--max-error", "1%%"},     {"--max-seconds", "1s"},   {"--w-area", "nan"},
        {"--w-boundary", "-1"},     {"--w-normal", "inf"},     {"--w-uv", "-1"},
        {"--w-plane-area", "-1"},   {"--weld", "-1"},          {"--virtual-edges", "2"},
        {"--prune", "0"},           {"--texture-size", "100"}, {"--image-format", "jpeg:0"},
        {"--normals", "smooth:400"}};
    for (const auto& [option, value] : wrong) {
        CAPTURE(option, value);
        const Outcome outcome = run(folder, std::string("simplify a.glb b.glb ") + option + "=" + value);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find(option) != std::string::npos);
        CHECK(outcome.err.find('_') == std::string::npos);
        CHECK(outcome.err.find("::") == std::string::npos);
        CHECK(outcome.err.size() < 200);
        CHECK(!fs::exists(folder / "b.glb"));
    }
}

TEST_CASE("short forms give the same as long ones") {
    const ModelFolder folder("in.glb", sheet(8));
    REQUIRE(run(folder, "simplify in.glb out.glb --ratio 0.2 --bake none --quiet").code == 0);
    const std::string expected = read(folder / "out.glb");
    for (const char* words : {"in.glb out.glb -fqr.2", "./in.glb -f -r 20% -q -o out.glb",
                              "-o out.glb simplify", "simplify --output out.glb in.glb -fqr0.2"}) {
        CAPTURE(words);
        const bool is_short = !std::string(words).starts_with("-o");
        const Outcome outcome = run(folder, std::string(words) + " --bake none");
        CHECK(outcome.code == (is_short ? 0 : 2));
        CHECK(outcome.out.empty());
        CHECK(read(folder / "out.glb") == expected);
    }
    CHECK(run(folder, "help lod").out == run(folder, "lod --help").out);
    CHECK(run(folder, "").out == run(folder, "--help").out);
    REQUIRE(run(folder, "render in.glb in.glb -o a.png --size 32").code == 0);
    REQUIRE(run(folder, "render in.glb in.glb b.png --size 32").code == 0);
    CHECK(read(folder / "a.png") == read(folder / "b.png"));
}

TEST_CASE("bad input exits with 3 and an unknown file format with 4") {
    const Folder folder;
    write(folder / "garbage.glb", std::string("glTF\2\0\0\0\xff\xff\0\0", 12));
    write(folder / "model.xyz", "1 2 3");
    write(folder / "empty.obj", "v 0 0 0\n");
    for (const std::string before : {"simplify ", "info ", "compare ", "render "}) {
        const std::string after = before == "simplify " ? " out.glb"
                                  : before == "render " ? " out.png"
                                  : before == "info "   ? ""
                                                        : " empty.obj";
        CAPTURE(before);
        const Outcome missing = run(folder, before + "missing.glb" + after);
        CHECK(missing.code == 3);
        CHECK(missing.err.find("missing.glb") != std::string::npos);
        CHECK(run(folder, before + "garbage.glb" + after).code == 3);
        CHECK(run(folder, before + "model.xyz" + after).code == 4);
    }
    write(folder / "nothing.gltf", R"({"asset":{"version":"2.0"}})");
    for (const auto& [arguments, message] :
         {std::pair("simplify empty.obj out.glb", "empty.obj: no faces"),
          {"compare empty.obj empty.obj", "empty.obj: no faces"},
          {"render empty.obj out.png", "empty.obj: no faces"},
          {"simplify nothing.gltf out.glb", "nothing.gltf: has no triangles"},
          {"compare nothing.gltf nothing.gltf", "nothing.gltf: has no face with non-zero area"},
          {"render nothing.gltf out.png", "nothing.gltf: has no triangles"}}) {
        CAPTURE(arguments);
        const Outcome empty = run(folder, arguments);
        CHECK(empty.code == 3);
        CHECK(empty.err.find(message) != std::string::npos);
    }
    CHECK(!fs::exists(folder / "out.glb"));
    CHECK(!fs::exists(folder / "out.png"));
}

TEST_CASE("an output file that is the input is rejected, also through links") {
    const ModelFolder folder("in.glb", sheet(8));
    const std::string before = read(folder / "in.glb");
    fs::create_symlink("in.glb", folder / "link.glb");
    fs::create_hard_link(folder / "in.glb", folder / "hard.glb");
    fs::create_directory_symlink(".", folder / "here");
    for (const char* out : {"in.glb", "./in.glb", "link.glb", "hard.glb", "here/in.glb"}) {
        CAPTURE(out);
        CHECK(run(folder, std::string("simplify in.glb ") + out).code == 2);
        CHECK(run(folder, std::string("simplify --force in.glb ") + out).code == 2);
        CHECK(run(folder, std::string("simplify --force in.glb new.glb --report ") + out).code == 2);
        CHECK(run(folder, std::string("simplify --force in.glb new.glb --history ") + out).code == 2);
    }
    CHECK(run(folder, "simplify in.glb new.glb --report new.glb").code == 2);
    CHECK(run(folder, "simplify in.glb new.glb --report r --history ./r").code == 2);
    for (const char* same : {"\"$PWD/new.glb\"", "here/new.glb", "../$(basename \"$PWD\")/new.glb"}) {
        CAPTURE(same);
        const Outcome outcome =
            run(folder, std::string("simplify in.glb new.glb --bake none --force --report ") + same);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find("is given for two files") != std::string::npos);
    }
    CHECK(run(folder, "lod in.glb . --bake none --force --history \"$PWD/in_LOD1.glb\"").code == 2);
    CHECK(read(folder / "in.glb") == before);
    CHECK(fs::is_symlink(folder / "link.glb"));
    CHECK(!fs::exists(folder / "new.glb"));
}

TEST_CASE("existing files are overwritten only with --force") {
    const ModelFolder folder("in.glb", sheet(8));
    const std::map<std::string, std::string> commands = {
        {"out.glb", "simplify in.glb out.glb --bake none"},
        {"report.json", "simplify in.glb new.glb --bake none --report report.json"},
        {"out.png", "render in.glb out.png --size 16"},
        {"in_LOD1.glb", "lod in.glb . --levels 0.5 --bake none"},
        {"page.html", "report in.glb in.glb page.html --without-view --size 16 --views 1 --samples 100"}};
    for (const auto& [file, command] : commands) {
        CAPTURE(command);
        write(folder / file, "precious");
        CHECK(run(folder, command).code == 7);
        CHECK(read(folder / file) == "precious");
        for (const char* other : {"new.glb", "in_LOD0.glb"}) CHECK(!fs::exists(folder / other));
    }
    for (const auto& [file, command] : commands) {
        CHECK(run(folder, command + " --force").code == 0);
        CHECK(read(folder / file) != "precious");
    }
}

TEST_CASE("output files that cannot be written are reported before the input is read") {
    const ModelFolder folder("in.glb", sheet(8));
    fs::create_directory(folder / "folder.glb");
    CHECK(run(folder, "simplify in.glb out.xyz").code == 2);
    CHECK(run(folder, "simplify in.glb out").code == 2);
    CHECK(run(folder, "simplify in.glb out.off").code == 2);
    CHECK(run(folder, "simplify in.glb nowhere/out.glb").code == 7);
    CHECK(run(folder, "simplify in.glb folder.glb --force").code == 7);
    CHECK(run(folder, "simplify in.glb out.glb --report nowhere/r.json").code == 7);
    CHECK(!fs::exists(folder / "out.glb"));
    // The output is checked before the missing input is opened.
    CHECK(run(folder, "simplify missing.glb nowhere/out.glb").code == 7);
}

TEST_CASE("no colour escape sequences are written on a terminal") {
    const ModelFolder folder("in.glb", sheet(8));
    for (const char* environment : {"NO_COLOR=1", "CLICOLOR_FORCE=1"}) {
        const std::string command =
            "cd '" + folder.path().string() + "' && " + environment + " script -qec \"'" + tool_path +
            "' simplify in.glb out.glb --force --bake none\" seen >/dev/null </dev/null";
        REQUIRE(std::system(command.c_str()) == 0);
        const std::string seen = read(folder / "seen");
        CHECK(seen.find("load [") != std::string::npos);  // the progress bar
        for (std::size_t at = seen.find("\x1b["); at != std::string::npos; at = seen.find("\x1b[", at + 1))
            CHECK(seen.compare(at, 3, "\x1b[K") == 0);  // erases a line
    }
}

TEST_CASE("failing to write to standard output exits with 7") {
    const ModelFolder folder("in.glb", sheet(4));
    const std::string command =
        std::string("'") + tool_path + "' info '" + (folder / "in.glb").string() + "' >/dev/full 2>/dev/null";
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 7);
}
