#include <map>
#include <nlohmann/json.hpp>

#include "cli/files/sha256.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/format_support.hpp"

using namespace tool_test;
using faqem::testing::contains;

namespace {

using Json = nlohmann::json;

/// Twelve models, and models.jsonl with them.
struct ListedModels : Folder {
    ListedModels() {
        fs::create_directories(*this / "in/sub");
        for (unsigned i = 0; i < 12; ++i)
            faqem::save(sheet(4 + i), *this / ("in/" + std::string(i % 2 ? "sub/" : "") + "m" +
                                               std::to_string(i) + ".ply"));
        REQUIRE(run(*this, "list in -o models.jsonl").code == 0);
    }
};

/// The results of a folder by the name of their model, whatever folder they are in.
std::map<std::string, std::string> results(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        std::string name = entry.path().filename();
        if (entry.path().extension() != ".glb") continue;
        if (const std::size_t end = name.find(".ply"); end != std::string::npos) name.erase(end, 4);
        if (const std::size_t slash = name.find("%2F"); slash != std::string::npos) name.erase(0, slash + 3);
        files[name] = read(entry.path());
    }
    return files;
}

/// Appends an attempt to the records of a shard.
void add_attempt(const Folder& folder, int number, const std::vector<Json>& lines) {
    std::string text;
    for (const Json& line : lines) text += line.dump() + "\n";
    write(folder / ("out/.faqem-batch/0-of-1/0" + std::to_string(number) + ".jsonl"), text);
}

const std::string shard_words = "batch --list models.jsonl out --bake none --threads 1 ";

}  // namespace

TEST_CASE("the shards of a list have the bytes of one batch, and a second run begins no model") {
    const ListedModels folder;
    REQUIRE(run(folder, "batch in plain --bake none --threads 1").code == 0);
    std::size_t models = 0;
    for (const char* shard : {"0/3", "1/3", "2/3"}) {
        CHECK(run(folder, "batch --missing out").code == (models == 0 ? 3 : 0));
        const Outcome outcome = run(folder, shard_words + "--shard " + shard);
        CHECK(outcome.code == 0);
        models += json_lines(outcome.out).size();
    }
    CHECK(models == 12);
    CHECK(results(folder / "out") == results(folder / "plain"));
    CHECK(run(folder, "batch --missing out").out.empty());
    const Outcome again = run(folder, shard_words + "--shard 1/3");
    CHECK(again.code == 0);
    CHECK(again.out.empty());
    CHECK(run(folder, "batch --merge out").code == 0);
    const auto merged = json_lines(read(folder / "out/batch.jsonl"));
    REQUIRE(merged.size() == 12);
    for (const Json& line : merged) CHECK(line["event"] == "done");
    CHECK(contains(read(folder / "out/batch.html"), "<td>12</td>"));
}

TEST_CASE("a result that is missing or has another size is made again, all others are not") {
    const ListedModels folder;
    REQUIRE(run(folder, shard_words).code == 0);
    for (const auto& entry : fs::recursive_directory_iterator(folder / "out"))
        if (entry.path().filename() == "m0.ply.glb") write(entry.path(), "cut");
    const auto lines = json_lines(run(folder, shard_words).out);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0]["path"] == "m0.ply");
    CHECK(lines[0]["status"] == "done");
    CHECK(json_lines(run(folder, shard_words + "--force").out).size() == 12);
}

TEST_CASE("models that cannot be read are refused, and the shard is complete") {
    const ListedModels folder;
    write(folder / "in/m0.ply", "no model");
    const Outcome outcome = run(folder, shard_words);
    CHECK(outcome.code == 0);
    for (const Json& line : json_lines(outcome.out))
        if (line["code"] != 0)
            CHECK(contains(line["message"].get<std::string>(), "its SHA-256 is another one"));
    CHECK(run(folder, shard_words).out.empty());
}

TEST_CASE("a model whose attempts ended without an end five times, or that crashed twice, is given up") {
    const ListedModels folder;
    REQUIRE(run(folder, shard_words).code == 0);
    Json started;
    for (const auto& entry : fs::directory_iterator(folder / "out/.faqem-batch/0-of-1"))
        if (entry.path().extension() == ".jsonl")
            for (const Json& line : json_lines(read(entry.path())))
                if (line["event"] == "started" && line["id"] == "m0.ply") started = line;
    REQUIRE(started.is_object());
    fs::remove_all(folder / "out/.faqem-batch/0-of-1");
    fs::create_directory(folder / "out/.faqem-batch/0-of-1");
    SECTION("four times without an end") {
        for (int i = 0; i < 4; ++i) add_attempt(folder, i, {started});
        CHECK(json_lines(run(folder, shard_words).out).size() == 12);
    }
    SECTION("five times without an end") {
        for (int i = 0; i < 5; ++i) add_attempt(folder, i, {started});
        const auto lines = json_lines(run(folder, shard_words).out);
        REQUIRE(lines.size() == 12);
        CHECK(lines[0]["status"] == "poisoned");
    }
    SECTION("two crashes") {
        Json crashed = started;
        crashed["event"] = "crashed";
        crashed["message"] = "signal 11";
        for (int i = 0; i < 2; ++i) add_attempt(folder, i, {started, crashed});
        const Outcome outcome = run(folder, shard_words);
        CHECK(outcome.code == 0);
        CHECK(json_lines(outcome.out)[0]["message"] == "signal 11");
        CHECK(run(folder, "batch --merge out").code == 0);
    }
    SECTION("a last line that was cut counts as not written") {
        add_attempt(folder, 0, {started});
        write(folder / "out/.faqem-batch/0-of-1/00.jsonl", started.dump());
        CHECK(json_lines(run(folder, shard_words).out).size() == 12);
    }
}

TEST_CASE("another list, number of shards or other options are another run, which only --new-run allows") {
    const ListedModels folder;
    REQUIRE(run(folder, shard_words + "--shard 0/2").code == 0);
    for (const char* other : {"--shard 0/3", "--shard 1/2 --ratio 0.3"}) {
        const Outcome outcome = run(folder, shard_words + other);
        CHECK(outcome.code == 2);
        CHECK(contains(outcome.err, "--new-run"));
    }
    CHECK(run(folder, shard_words + "--shard 0/2 --ratio 0.3 --new-run").code == 0);
    write(folder / "models.jsonl",
          read(folder / "models.jsonl").substr(read(folder / "models.jsonl").find('\n') + 1));
    CHECK(run(folder, shard_words + "--shard 0/2 --ratio 0.3").code == 2);
    CHECK(run(folder, shard_words + "--shard 0/2 --ratio 0.3 --new-run").out.empty());
}

TEST_CASE("a list may give each model an output and options") {
    const ListedModels folder;
    write(folder / "models.jsonl",
          R"({"id":"a","input":"in/m0.ply","output":"x/y.obj","options":{"faces":10}})"
          "\n"
          R"({"id":"b","input":"in/m2.ply"})"
          "\n");
    const auto lines = json_lines(run(folder, shard_words + "--ratio 0.5").out);
    REQUIRE(lines.size() == 2);
    for (const Json& line : lines) {
        const int wanted = line["path"] == "a" ? 10 : 36;  // the last collapse removes one or two faces
        CHECK(line["faces_out"].get<int>() <= wanted);
        CHECK(line["faces_out"].get<int>() >= wanted - 1);
    }
    CHECK(fs::exists(folder / "out/x/y.obj"));
}

TEST_CASE("a table with sha256 and local_path is a list") {
    const ListedModels folder;
    write(folder / "table.csv", "name,sha256,local_path\n\"a, b\",0123,in/m0.ply\n");
    REQUIRE(run(folder, "list table.csv -o models.jsonl --force").code == 0);
    const auto lines = json_lines(read(folder / "models.jsonl"));
    REQUIRE(lines.size() == 1);
    CHECK(lines[0]["id"] == "0123");
    CHECK(lines[0]["input"] == "in/m0.ply");
    CHECK(run(folder, shard_words).code == 0);
}

TEST_CASE("the bytes of a model in lists and records are those of its files together") {
    const Folder folder;
    fs::create_directories(folder / "in");
    faqem::save(sheet(10), folder / "in/a.obj");  // with its library and image
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(folder / "in")) bytes += entry.file_size();
    REQUIRE(bytes > fs::file_size(folder / "in/a.obj"));
    REQUIRE(run(folder, "list in -o models.jsonl").code == 0);
    CHECK(json_lines(read(folder / "models.jsonl")).at(0)["bytes"] == bytes);
    write(folder / "models.jsonl", R"({"id":"a","input":"in/a.obj"})");
    REQUIRE(run(folder, shard_words).code == 0);
    REQUIRE(run(folder, "batch --merge out").code == 0);
    CHECK(json_lines(read(folder / "out/batch.jsonl")).at(0)["input_bytes"] == bytes);
}

TEST_CASE("a list is read once, so that it may come from a pipe") {
    const ListedModels folder;
    const std::string in = (folder / "in/m0.ply").string();
    for (const std::string end : {"\n", ""}) {
        const std::string list = R"({"id":"a","input":")" + in + "\"}" + end;
        write(folder / "models.jsonl", list);
        REQUIRE(std::system(("cd '" + folder.path().string() + "' && cat models.jsonl | '" + tool_path +
                             "' batch --list /dev/stdin out --new-run --bake none >/dev/null 2>&1")
                                .c_str()) == 0);
        CHECK(Json::parse(read(folder / "out/.faqem-batch/run.json"))["list"] == faqem::cli::sha256(list));
    }
}

TEST_CASE("lists that cannot be right are errors before the first model") {
    const ListedModels folder;
    const auto message = [&](const std::string& list) {
        write(folder / "models.jsonl", list);
        const Outcome outcome = run(folder, shard_words);
        CHECK(outcome.code == 3);
        CHECK(outcome.out.empty());
        return outcome.err;
    };
    CHECK(contains(message("{\"id\":\"a\",\"input\":\"in/m0.ply\"}\nno JSON\n"), "line 2"));
    CHECK(contains(message("{\"id\":\"a\"}\n"), "line 1"));
    CHECK(contains(message("{\"id\":\"a\",\"input\":\"in/m0.ply\",\"output\":\"../b.glb\"}\n"), "outside"));
    CHECK(contains(message("{\"id\":\"a\",\"input\":\"out/m0.ply\"}\n"), "inside"));
    CHECK(
        contains(message("{\"id\":\"a\",\"input\":\"in/m0.ply\"}\n{\"id\":\"a\",\"input\":\"in/m2.ply\"}\n"),
                 "this id"));
    CHECK(contains(message("{\"id\":\"a\",\"input\":\"in/m0.ply\",\"output\":\"x.glb\"}\n"
                           "{\"id\":\"b\",\"input\":\"in/m2.ply\",\"output\":\"x.glb\"}\n"),
                   "same output"));
    write(folder / "models.jsonl", "{\"id\":\"a\",\"input\":\"in/m0.ply\",\"options\":{\"rato\":1}}\n");
    CHECK(contains(run(folder, shard_words).err, "ratio"));
    // A line and a model, after the name of the list, once.
    CHECK(message("{\"id\":\"a\",\"input\":\"out/m0.ply\"}\n") ==
          "faqem: models.jsonl: line 1: a: the input out/m0.ply is inside the output directory\n");
    CHECK(message("[1]\n") == "faqem: models.jsonl: line 1: is no JSON object\n");
    CHECK(run(folder, "batch --list models.jsonl in out").code == 2);
    CHECK(run(folder, "batch in").code == 2);
    CHECK(run(folder, "batch --shard 0/2 in out").code == 2);
}

TEST_CASE("an empty name of a shard, as of a variable that is not set, is not the whole list") {
    const ListedModels folder;
    const Outcome outcome = run(folder, shard_words + "--shard \"\"");
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
}

TEST_CASE("a model whose id is too long for the name of a file does not stop its shard") {
    const ListedModels folder;
    std::string id;
    while (id.size() < 500) id += "\xc3\xa9";  // six bytes in a name
    write(folder / "models.jsonl", R"({"id":")" + id + R"(","input":"in/m0.ply"})" + "\n");
    for (const char* format : {"glb", "gltf", "obj"})
        CHECK(run(folder, shard_words + "--new-run --format " + format).code == 0);
    CHECK(run(folder, "batch --merge out").code == 0);
}

TEST_CASE("merging finds two models with one output in different shards") {
    const ListedModels folder;
    write(folder / "models.jsonl", R"({"id":"m0","input":"in/m0.ply","output":"x.glb"})"
                                   "\n"
                                   R"({"id":"m2","input":"in/m2.ply","output":"./x.glb"})"
                                   "\n");
    for (const char* shard : {"--shard 0/2", "--shard 1/2"})
        REQUIRE(run(folder, shard_words + shard).code == 0);
    const Outcome merged = run(folder, "batch --merge out");
    CHECK(merged.code == 9);
    CHECK(merged.err == "faqem: out: x.glb is the output of two models: m0 and m2\n");
}

TEST_CASE("a shard whose records cannot be written is to be tried again, and the next attempt completes it") {
    const ListedModels folder;
    const std::string words = "batch --list models.jsonl out --bake none --faces 4 --format ply --jobs 1";
    // No file may have more than 4096 bytes. Twelve models have more in their records, and fewer in each result.
    const int status =
        std::system(("cd '" + folder.path().string() + "' && ulimit -f 8 && trap '' XFSZ && '" + tool_path +
                     "' " + words + " >lines 2>errors")
                        .c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 75);
    CHECK(contains(read(folder / "errors"), ".jsonl: cannot write: File too large\n"));
    CHECK(run(folder, words).code == 0);
    CHECK(run(folder, "batch --merge out").out == "done: 12\n");
}

TEST_CASE("a shard that is ended by a signal exits with 75, and the next attempt completes it") {
    const Folder folder;
    fs::create_directory(folder / "in");
    for (const char* name : {"in/a.glb", "in/b.glb", "in/c.glb"}) faqem::save(sheet(150), folder / name);
    REQUIRE(run(folder, "list in -o models.jsonl").code == 0);
    const pid_t process = start(folder, "batch", "--list", "models.jsonl", "out", "--bake", "none");
    CHECK(signal_and_wait(process, SIGTERM) == 75);
    CHECK(run(folder, "batch --missing out").out ==
          "--array=0 --export=ALL,FAQEM_SHARD_COUNT=1,FAQEM_SHARD_OFFSET=0\n");
    CHECK(run(folder, "batch --list models.jsonl out --bake none").code == 0);
    CHECK(results(folder / "out").size() == 3);
}
