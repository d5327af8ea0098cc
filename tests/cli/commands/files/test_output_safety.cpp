// Output files are written atomically: after any failure a file is unchanged, complete or missing.

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>

#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/format_support.hpp"

using namespace tool_test;
using faqem::testing::contains;

namespace {

std::set<std::string> names_in(const Folder& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path())) names.insert(entry.path().filename());
    return names;
}

/// As run(), but the shell executes `before` first.
Outcome run_after(const Folder& folder, const std::string& before, const std::string& arguments) {
    const Folder streams;
    const std::string command = "cd '" + folder.path().string() + "' && " + before + " && exec '" +
                                tool_path + "' " + arguments + " 2>'" + (streams / "err").string() +
                                "' >/dev/null";
    const int status = std::system(("sh -c \"" + command + "\"").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", read(streams / "err")};
}

}  // namespace

TEST_CASE("a failed write exits with 7, keeps the old file and leaves no temporary file") {
    // A limit of the file size simulates a full disk: write() fails after part of the file is written.
    const ModelFolder folder("in.glb", sheet(40));
    write(folder / "old.glb", "precious");
    for (const char* out : {"new.glb", "old.glb --force", "new.gltf", "new.obj", "new.ply", "new.stl"}) {
        CAPTURE(out);
        const Outcome outcome =
            run_after(folder, "ulimit -f 4",
                      std::string("simplify in.glb ") + out + " --ratio 0.9 --bake none --quiet");
        CHECK(outcome.code == 7);
        CHECK(contains(outcome.err, "cannot write: File too large"));
        CHECK(contains(outcome.err, std::string(out).substr(0, 4)));
        CHECK(names_in(folder) == std::set<std::string>{"in.glb", "old.glb"});
        CHECK(read(folder / "old.glb") == "precious");
    }
}

TEST_CASE("a full or read-only file system exits with 7, keeps the old file and leaves no temporary file") {
    // A file system of four pages, mounted in a private mount namespace.
    if (std::system("unshare -rm mount -t tmpfs -o size=16k none /mnt 2>/dev/null") != 0) {
        WARN("skipped: mounting a file system is not permitted");
        return;
    }
    const ModelFolder folder("in.glb", sheet(40));
    for (const std::string out : {"new.glb", "old.glb", "new.gltf", "new.obj", "new.ply", "new.stl"}) {
        CAPTURE(out);
        const std::string simplify = std::string("'") + tool_path + "' simplify in.glb /mnt/" + out +
                                     " --ratio 0.9 --bake none --quiet --force 2>> err";
        write(folder / "script", "mount -t tmpfs -o size=16k none /mnt\nprintf precious > /mnt/old.glb\n" +
                                     simplify + "\necho $? $(ls -A /mnt) $(cat /mnt/old.glb) >> out\n" +
                                     "mount -o remount,ro none /mnt\n" + simplify +
                                     "\necho $? $(ls -A /mnt) $(cat /mnt/old.glb) >> out\n");
        fs::remove(folder / "out");
        fs::remove(folder / "err");
        REQUIRE(std::system(("cd '" + folder.path().string() + "' && unshare -rm sh script").c_str()) == 0);
        CHECK(read(folder / "out") == "7 old.glb precious\n7 old.glb precious\n");
        CHECK(contains(read(folder / "err"), "cannot write: No space left on device"));
        CHECK(contains(read(folder / "err"), ": the directory is not writable"));
        CHECK(contains(read(folder / "err"), "/mnt/" + out.substr(0, 4)));
    }
}

TEST_CASE("devices and pipes are rejected as output files before the input is read") {
    const ModelFolder folder("in.glb", sheet(4));
    REQUIRE(::mkfifo((folder / "fifo.glb").c_str(), 0600) == 0);
    fs::create_symlink("/dev/full", folder / "full.glb");
    for (const char* out : {"full.glb", "fifo.glb"}) {
        CAPTURE(out);
        const Outcome outcome = run(folder, std::string("simplify missing.glb ") + out + " --force");
        CHECK(outcome.code == 7);
        CHECK(contains(outcome.err, std::string(out) + ": is not a regular file"));
    }
    CHECK(run(folder, "simplify in.glb new.glb --force --report /dev/full").code == 7);
    CHECK(run(folder, "simplify in.glb new.glb --force --history /dev/full").code == 7);
    CHECK(!fs::exists(folder / "new.glb"));
}

TEST_CASE("an output directory that is not writable exits with 7") {
    const ModelFolder folder("in.glb", sheet(4));
    fs::create_directory(folder / "locked");
    write(folder / "locked/old.glb", "precious");
    REQUIRE(::chmod((folder / "locked").c_str(), 0555) == 0);
    if (::geteuid() != 0) {  // permissions do not apply to root
        for (const char* out : {"locked/new.glb", "locked/old.glb --force"}) {
            const Outcome outcome = run(folder, std::string("simplify in.glb ") + out);
            CHECK(outcome.code == 7);
            CHECK(contains(outcome.err, "locked/"));
        }
        CHECK(read(folder / "locked/old.glb") == "precious");
    }
    ::chmod((folder / "locked").c_str(), 0755);
    // No user can create files in /proc, not even root.
    const Outcome outcome = run(folder, "simplify in.glb /proc/new.glb --bake none --quiet");
    CHECK(outcome.code == 7);
    CHECK(contains(outcome.err, "/proc/new.glb: cannot create a temporary file in its folder"));
}

TEST_CASE("the next run in a folder removes temporary files of dead runs, but not those in use") {
    const ModelFolder folder("in.glb", sheet(4));
    fs::create_directory(folder / "out");
    const std::string dead = "out/.faqem-00000000000000000000dead.tmp",
                      used = "out/.faqem-00000000000000000000beef.tmp";
    write(folder / dead, "left");
    write(folder / used, "being written");
    const int file = ::open((folder / used).c_str(), O_RDONLY);
    REQUIRE(::flock(file, LOCK_EX) == 0);
    CHECK(run(folder, "simplify in.glb out/new.glb --bake none --quiet").code == 0);
    CHECK(!fs::exists(folder / dead));
    CHECK(fs::exists(folder / used));
    ::close(file);
    CHECK(run(folder, "simplify in.glb out/newer.glb --bake none --quiet").code == 0);
    CHECK(!fs::exists(folder / used));
}
