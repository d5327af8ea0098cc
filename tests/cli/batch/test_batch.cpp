#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

std::string status(const Outcome& outcome, const std::string& name) {
    const auto lines = lines_by_path(outcome);
    return lines.contains(name) ? lines.at(name)["status"].get<std::string>() : "none";
}

/// Has in/a.glb, in/sub/b.obj with its library and image, and in/sub/c.ply.
struct Models : Folder {
    Models() {
        fs::create_directories(*this / "in/sub");
        faqem::save(sheet(8), *this / "in/a.glb");
        faqem::save(sheet(10), *this / "in/sub/b.obj");
        faqem::save(sheet(6), *this / "in/sub/c.ply");
    }
};

/// Changes the modification time of a file, but not its content.
void touch(const fs::path& file) {
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(3));
}

const std::string batch = "batch in out --texture-size 64 --ratio 0.5 ";

}  // namespace

TEST_CASE("batch writes the same bytes as simplify for every model of a directory tree") {
    const Models folder;
    write(folder / "in/notes.txt", "no model");
    const Outcome outcome = run(folder, batch + "--jobs 2");
    CHECK(outcome.code == 0);
    // Beside the notes there are the material library and the image of b.obj.
    CHECK(outcome.err == "faqem: 3 models: 3 done; 3 other files passed over\n");
    const auto lines = lines_by_path(outcome);
    REQUIRE(lines.size() == 3);
    for (const auto& [in, out] : std::map<std::string, std::string>{
             {"a.glb", "a.glb"}, {"sub/b.obj", "sub/b.glb"}, {"sub/c.ply", "sub/c.glb"}}) {
        CAPTURE(in);
        const nlohmann::json& line = lines.at(in);
        CHECK(line["result"] == out);
        CHECK(line["status"] == "done");
        CHECK(line["code"] == 0);
        CHECK(line["message"].get<std::string>().empty());
        CHECK(line["seconds"] >= 0.0);
        CHECK(line["faces_out"] > 0);
        CHECK(line["faces_out"].get<int>() * 2 <= line["faces_in"].get<int>());
        REQUIRE(run(folder, "simplify in/" + in + " one.glb --force --texture-size 64 --ratio 0.5").code ==
                0);
        CHECK(read(folder / "one.glb") == read(folder / ("out/" + out)));
    }
    CHECK(lines.at("a.glb")["faces_in"] == 128);
}

TEST_CASE("batch --format selects the output format") {
    const Models folder;
    CHECK(run(folder, batch + "--format ply").code == 0);
    CHECK(fs::exists(folder / "out/sub/b.ply"));
    CHECK(run(folder, "batch in other --format off").code == 2);
    CHECK(!fs::exists(folder / "other"));
}

TEST_CASE("a failing model does not stop a batch and its line has the code and message of simplify") {
    const Models folder;
    write(folder / "in/broken.ply", "ply\nno header");
    write(folder / "in/empty.obj", "v 0 0 0\n");
    write(folder / "in/point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    const Outcome outcome = run(folder, batch + "--jobs 2");
    CHECK(outcome.code == 9);
    const auto lines = lines_by_path(outcome);
    REQUIRE(lines.size() == 6);
    for (const char* name : {"broken.ply", "empty.obj", "point.obj"}) {
        CAPTURE(name);
        CHECK(lines.at(name)["status"] == "failed");
        CHECK(lines.at(name)["code"] == 3);
        CHECK(lines.at(name)["message"].get<std::string>().find(name) != std::string::npos);
    }
    CHECK(status(outcome, "a.glb") == "done");
    CHECK(lines.at("point.obj")["message"].get<std::string>().find("nothing is left of ") == 0);
    CHECK(!fs::exists(folder / "out/broken.glb"));
    CHECK(!fs::exists(folder / "out/point.glb"));
}

TEST_CASE("batch reports links that lead to no file as models that cannot be read") {
    const Folder folder;
    fs::create_directories(folder / "in/sub");
    fs::create_symlink("../elsewhere/gone.obj", folder / "in/sub/moved.obj");
    fs::create_symlink("loop.ply", folder / "in/loop.ply");
    fs::create_symlink("nowhere", folder / "in/notes");  // does not have the name of a model
    const auto check_links = [](const std::map<std::string, nlohmann::json>& lines) {
        for (const auto& [name, reason] :
             {std::pair("sub/moved.obj",
                        "in/sub/moved.obj: is a link to ../elsewhere/gone.obj: No such file"),
              {"loop.ply", "in/loop.ply: is a link to loop.ply: "}}) {
            CAPTURE(name);
            REQUIRE(lines.contains(name));
            CHECK(lines.at(name)["status"] == "failed");
            CHECK(lines.at(name)["code"] == 3);
            CHECK(lines.at(name)["message"].get<std::string>().find(reason) == 0);
        }
    };
    const Outcome links = run(folder, batch);
    CHECK(links.code == 9);
    CHECK(lines_by_path(links).size() == 2);
    check_links(lines_by_path(links));
    // Models beside them, and links to these, are processed.
    faqem::save(sheet(8), folder / "in/a.glb");
    fs::create_symlink("../a.glb", folder / "in/sub/b.glb");
    for (const char* resume : {"", "--resume"}) {
        const Outcome outcome = run(folder, batch + resume);
        CHECK(outcome.code == 9);
        CHECK(lines_by_path(outcome).size() == 4);
        check_links(lines_by_path(outcome));
        CHECK(lines_by_path(outcome).at("sub/b.glb")["code"] == 0);
    }
}

TEST_CASE("batch applies --max-error and --strict to each model") {
    const Models folder;
    const Outcome outcome = run(folder, batch + "--max-error 1e-9");
    CHECK(outcome.code == 9);
    CHECK(lines_by_path(outcome).at("a.glb")["code"] == 6);
    const std::string message = lines_by_path(outcome).at("a.glb")["message"];
    CHECK(message.find("in/a.glb: max error exceeded: ") == 0);
    CHECK(message.find("; out/a.glb was not written") != std::string::npos);
    CHECK(!fs::exists(folder / "out/a.glb"));
    // Dropping a duplicate face is a repair, which is an error with --strict. The other results were written
    // without
    // --strict, so they are out of date.
    write(folder / "in/twice.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 4 1 3\n");
    CHECK(status(run(folder, batch), "twice.obj") == "done");
    const Outcome strict = run(folder, batch + "--strict --resume");
    CHECK(strict.code == 9);
    CHECK(lines_by_path(strict).at("twice.obj")["code"] == 3);
    CHECK(status(strict, "a.glb") == "done");
}

TEST_CASE("two models with the same output file are an error before the batch starts") {
    const Models folder;
    faqem::save(sheet(4), folder / "in/a.stl");
    const Outcome outcome = run(folder, batch);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("a.glb") != std::string::npos);
    CHECK(outcome.err.find("a.stl") != std::string::npos);
    CHECK(!fs::exists(folder / "out"));
}

TEST_CASE("batch does not read its results as models and does not overwrite its models") {
    const Models folder;
    CHECK(run(folder, "batch in in").code == 2);
    CHECK(run(folder, "batch in in/sub/..").code == 2);
    CHECK(run(folder, "batch in in/out --texture-size 64").code == 0);
    CHECK(lines_by_path(run(folder, "batch in in/out --texture-size 64 --force")).size() == 3);
    // linked/a.glb is a hard link to in/a.glb.
    fs::create_directory(folder / "linked");
    fs::create_hard_link(folder / "in/a.glb", folder / "linked/a.glb");
    const std::string before = read(folder / "in/a.glb");
    CHECK(run(folder, "batch in linked --force").code == 2);
    CHECK(read(folder / "in/a.glb") == before);
}

TEST_CASE("batch exits with 3 if the input directory is missing or has no models") {
    const Folder folder;
    CHECK(run(folder, "batch nowhere out").code == 3);
    fs::create_directories(folder / "in/.faqem-set/new");  // of a run that was killed
    write(folder / "in/.faqem-set/new/a.glb", "");
    CHECK(run(folder, "batch in out").code == 3);
    CHECK(!fs::exists(folder / "out"));
}

TEST_CASE("batch overwrites existing files only with --force") {
    const Models folder;
    fs::create_directory(folder / "out");
    write(folder / "out/a.glb", "precious");
    for (const char* resume : {"", "--resume"}) {
        const Outcome outcome = run(folder, batch + resume);
        CHECK(outcome.code == 9);
        const nlohmann::json line = lines_by_path(outcome).at("a.glb");
        CHECK(line["code"] == 7);
        CHECK(line["message"] ==
              "out/a.glb: the file exists; --resume skips what is up to date, --force overwrites it");
        CHECK(read(folder / "out/a.glb") == "precious");
    }
    CHECK(run(folder, batch + "--force").code == 0);
    CHECK(read(folder / "out/a.glb") != "precious");
}

TEST_CASE("batch --resume processes only models that are new, changed or without result") {
    const Models folder;
    const auto again = [&](const std::string& name) { return status(run(folder, batch + "--resume"), name); };
    REQUIRE(run(folder, batch + "--resume").code == 0);
    const Outcome second = run(folder, batch + "--resume");
    CHECK(second.code == 0);
    for (const auto& [name, line] : lines_by_path(second)) {
        CAPTURE(name);
        CHECK(line["status"] == "skipped");
        CHECK(line["faces_in"] > 0);
    }
    SECTION("a model that changed") {
        touch(folder / "in/a.glb");
        const Outcome outcome = run(folder, batch + "--resume");
        CHECK(status(outcome, "a.glb") == "done");
        CHECK(status(outcome, "sub/c.ply") == "skipped");
    }
    SECTION("a referenced material library or image that changed") {
        touch(folder / "in/sub/b.mtl");
        CHECK(again("sub/b.obj") == "done");
        touch(folder / "in/sub/b_0.png");
        const Outcome outcome = run(folder, batch + "--resume");
        CHECK(status(outcome, "sub/b.obj") == "done");
        CHECK(status(outcome, "a.glb") == "skipped");
    }
    SECTION("other options") {
        CHECK(status(run(folder, batch + "--resume --preset fast"), "a.glb") == "done");
        CHECK(status(run(folder, batch + "--resume --preset fast --threads 2"), "a.glb") == "skipped");
        CHECK(status(run(folder, batch + "--resume"), "a.glb") == "done");
    }
    SECTION("a result that was deleted") {
        fs::remove(folder / "out/a.glb");
        CHECK(again("a.glb") == "done");
    }
    SECTION("a new model") {
        faqem::save(sheet(5), folder / "in/new.stl");
        CHECK(again("new.stl") == "done");
    }
    SECTION("a result that was changed is not overwritten") {
        write(folder / "out/a.glb", "precious");
        touch(folder / "in/a.glb");
        CHECK(again("a.glb") == "failed");
        CHECK(read(folder / "out/a.glb") == "precious");
        CHECK(status(run(folder, batch + "--resume --force"), "a.glb") == "done");
    }
}

TEST_CASE("batch --resume redoes a result whose record is truncated") {
    const Models folder;
    REQUIRE(run(folder, batch + "--jobs 1").code == 0);
    const fs::path record = fs::directory_iterator(folder / "out/.faqem-batch/directory")->path();
    // Only the first entry of this result remains, which says that it was begun, so that it may be
    // overwritten.
    fs::resize_file(record, fs::file_size(record) - 20);
    const Outcome outcome = run(folder, batch + "--resume");
    CHECK(outcome.code == 0);
    int done = 0;
    for (const auto& [name, line] : lines_by_path(outcome)) done += line["status"] == "done";
    CHECK(done == 1);
    for (const auto& [name, line] : lines_by_path(run(folder, batch + "--resume")))
        CHECK(line["status"] == "skipped");
}

TEST_CASE("batch exits with 8 after a signal and can be resumed") {
    const Folder folder;
    fs::create_directory(folder / "in");
    for (const char* name : {"in/a.glb", "in/b.glb", "in/c.glb"}) faqem::save(sheet(150), folder / name);
    CHECK(signal_and_wait(start(folder, "batch", "in", "out", "--bake", "none"), SIGTERM) == 8);
    // Cancelled models have a line, too.
    CHECK(lines_by_path({0, read(folder / "lines"), ""}).size() == 3);
    const Outcome outcome = run(folder, "batch in out --bake none --resume");
    CHECK(outcome.code == 0);
    CHECK(lines_by_path(outcome).size() == 3);
}

TEST_CASE("batch --resume keeps a file that was there before an attempt that did not end") {
    const Models folder;
    REQUIRE(run(folder, batch + "--jobs 1").code == 0);
    const auto file_record = [&] {
        return fs::directory_iterator(folder / "out/.faqem-batch/directory")->path();
    };
    std::string lines = read(file_record());
    // The process was killed after the first model, the largest, had begun.
    const auto started = nlohmann::json::parse(lines.substr(0, lines.find('\n')));
    REQUIRE(started["event"] == "started");
    CHECK(started["replaced"] == "");
    SECTION("a file that is newer than the start may be the result") {
        write(file_record(), started.dump() + "\n");
        CHECK(status(run(folder, batch + "--resume"), started["id"]) == "done");
    }
    SECTION("a file that is the one of the start is another's") {
        fs::remove(file_record());
        fs::remove(folder / "out" / started["result"].get<std::string>());
        write(folder / "out" / started["result"].get<std::string>(), "precious");
        CHECK(status(run(folder, batch), started["id"]) == "failed");
        CHECK(status(run(folder, batch + "--resume"), started["id"]) == "failed");
    }
}

TEST_CASE("batch completes with a memory limit below the estimate of each model") {
    const Models folder;
    CHECK(run(folder, batch + "--jobs 3 --max-memory 1MB").code == 0);
    for (const char* wrong : {"--max-memory 0", "--max-memory much", "--max-memory -1GB", "--jobs -1"}) {
        CAPTURE(wrong);
        CHECK(run(folder, batch + "--force " + wrong).code == 2);
    }
}
