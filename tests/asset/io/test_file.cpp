#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <thread>

#include "asset/io/file.hpp"
#include "asset/io/file_set.hpp"
#include "asset/io/temporary_file.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

std::size_t files_in(const TemporaryFolder& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

mode_t mode_of(const fs::path& file) {
    struct stat status = {};
    REQUIRE(::stat(file.c_str(), &status) == 0);
    return status.st_mode & 07777;
}

}  // namespace

TEST_CASE("all bytes of a file are read", "[file]") {
    const TemporaryFolder folder;
    put(folder / "a", std::string("x\0\xFFy", 4));
    CHECK(read_file(folder / "a") == std::vector<std::uint8_t>{'x', 0, 255, 'y'});
    put(folder / "empty", "");
    CHECK(read_file(folder / "empty").empty());
}

TEST_CASE("files larger than the size limit are rejected", "[file]") {
    const TemporaryFolder folder;
    put(folder / "a", "12345");
    CHECK(read_file(folder / "a", 5).size() == 5);
    const std::string message = message_of<ReadError>([&] { read_file(folder / "a", 4); });
    CHECK(contains(message, (folder / "a").string()));
    CHECK(contains(message, "has 5 bytes"));
}

TEST_CASE("only regular files are read and a FIFO does not block", "[file]") {
    const TemporaryFolder folder;
    REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
    CHECK(contains(message_of<ReadError>([&] { read_file(folder / "fifo"); }), "regular"));
    CHECK(contains(message_of<ReadError>([&] { read_file(folder.path()); }), "regular"));
    CHECK(contains(message_of<ReadError>([&] { read_file("/dev/zero"); }), "regular"));
    CHECK(contains(message_of<ReadError>([&] { read_file(folder / "none"); }), "No such file"));
}

TEST_CASE("a new file gets default permissions and a replaced file keeps its permissions", "[file]") {
    const TemporaryFolder folder;
    const mode_t mask = ::umask(0027);
    write_file(folder / "a", bytes_of("new"), Overwrite::no);
    ::umask(mask);
    CHECK(get(folder / "a") == "new");
    CHECK(mode_of(folder / "a") == 0640);
    REQUIRE(::chmod((folder / "a").c_str(), 0604) == 0);
    write_file(folder / "a", bytes_of("newer"), Overwrite::yes);
    CHECK(get(folder / "a") == "newer");
    CHECK(mode_of(folder / "a") == 0604);
    CHECK(files_in(folder) == 1);
}

TEST_CASE("an existing file is not replaced unless overwriting is allowed", "[file]") {
    const TemporaryFolder folder;
    put(folder / "a", "old");
    const std::string message =
        message_of<WriteError>([&] { write_file(folder / "a", bytes_of("b"), Overwrite::no); });
    CHECK(contains(message, (folder / "a").string()));
    CHECK(contains(message, "File exists"));
    CHECK(get(folder / "a") == "old");
    CHECK(files_in(folder) == 1);
}

TEST_CASE("exactly one of several concurrent writers creates a new file", "[file]") {
    const TemporaryFolder folder;
    std::atomic<int> won{0}, lost{0};
    std::vector<std::thread> writers;
    for (int i = 0; i < 8; ++i)
        writers.emplace_back([&, i] {
            try {
                write_file(folder / "a", bytes_of(std::to_string(i)), Overwrite::no);
                ++won;
            } catch (const WriteError&) {
                ++lost;
            }
        });
    for (std::thread& writer : writers) writer.join();
    CHECK(won == 1);
    CHECK(lost == 7);
    CHECK(files_in(folder) == 1);
}

TEST_CASE("symbolic links are followed and a dangling link is not overwritten by default", "[file]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    put(folder / "sub/real", "old");
    fs::create_symlink("sub/real", folder / "link");
    write_file(folder / "link", bytes_of("new"), Overwrite::yes);
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(get(folder / "sub/real") == "new");
    fs::create_symlink("nowhere", folder / "dangling");
    CHECK_THROWS_AS(write_file(folder / "dangling", bytes_of("x"), Overwrite::no), WriteError);
    CHECK(!fs::exists(folder / "nowhere"));
}

TEST_CASE("writing to folders, devices and missing folders fails", "[file]") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(write_file(folder.path(), bytes_of("x"), Overwrite::yes), WriteError);
    CHECK_THROWS_AS(write_file("/dev/full", bytes_of("x"), Overwrite::yes), WriteError);
    CHECK_THROWS_AS(write_file(folder / "none/a", bytes_of("x"), Overwrite::yes), WriteError);
    CHECK(files_in(folder) == 0);
}

TEST_CASE("if one of several files exists, none is written by default", "[file]") {
    const TemporaryFolder folder;
    put(folder / "b", "old");
    const FileContent files[] = {{folder / "a", bytes_of("1")}, {folder / "b", bytes_of("2")}};
    CHECK_THROWS_AS(write_files(files, Overwrite::no), WriteError);
    CHECK(files_in(folder) == 1);
    write_files(files, Overwrite::yes);
    CHECK(get(folder / "a") == "1");
    CHECK(get(folder / "b") == "2");
}

TEST_CASE("a signal handler can remove the temporary file of a write in progress", "[file]") {
    const TemporaryFolder folder;
    // The write exceeds the file size limit; the resulting signal arrives while the temporary file exists. The handler
    // waits until this process has counted the files, since it can only call async-signal-safe functions.
    static std::array<int, 2> arrived, counted;
    REQUIRE(::pipe(arrived.data()) == 0);
    REQUIRE(::pipe(counted.data()) == 0);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    char byte = 0;
    if (child == 0) {
        std::signal(SIGXFSZ, [](int) {
            char signal = 0;
            if (::write(arrived[1], &signal, 1) != 1 || ::read(counted[0], &signal, 1) != 1) ::_exit(5);
            ::_exit(remove_temporary_files() ? 0 : 4);
        });
        ::close(arrived[0]), ::close(counted[1]);
        const struct rlimit limit = {1000, 1000};
        if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(2);
        try {
            write_file(folder / "a", bytes_of(std::string(5000, 'x')), Overwrite::no);
        } catch (...) {
        }
        ::_exit(3);
    }
    ::close(arrived[1]);
    const bool has_arrived = ::read(arrived[0], &byte, 1) == 1;  // false if the child ends without a signal
    const std::size_t before = files_in(folder);
    const bool was_told = ::write(counted[1], &byte, 1) == 1;
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    for (const int file : {arrived[0], counted[0], counted[1]}) ::close(file);
    CHECK(has_arrived);
    CHECK(was_told);
    CHECK(before == 1);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(files_in(folder) == 0);
}

TEST_CASE("references inside the folder are resolved", "[file]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub dir");
    put(folder / "sub dir/a b.png", "x");
    put(folder / "100%.png", "x");
    const fs::path expected = fs::canonical(folder / "sub dir/a b.png");
    CHECK(resolve_inside(folder.path(), "sub%20dir/a%20b.png") == expected);
    CHECK(resolve_inside(folder.path(), "./sub dir/../sub dir/a b.png") == expected);
    CHECK(resolve_inside(folder.path(), "sub dir\\a b.png", ReferenceSyntax::file_name) == expected);
    CHECK(resolve_inside(folder.path(), "100%.png").filename() == "100%.png");
    CHECK_THROWS_AS(resolve_inside(folder.path(), "sub%20dir/a%20b.png", ReferenceSyntax::file_name),
                    ReadError);
    CHECK_THROWS_AS(resolve_inside(folder.path(), "sub dir\\a b.png"), ReadError);
}

TEST_CASE("references outside the folder are rejected whether or not the file exists", "[file]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "in");
    put(folder / "secret", "x");
    put(folder / "in/a", "x");
    fs::create_symlink("../secret", folder / "in/link");
    fs::create_directory_symlink("..", folder / "in/up");
    fs::create_symlink("a", folder / "in/good");
    for (const char* reference :
         {"", "../secret", "..%2fsecret", "%2e%2e/secret", "a/../../secret", "../none", "/etc/passwd",
          "%2Fetc/passwd", "http://host/a", "HTTPS://host/a", "file:///etc/passwd", "file:a", "C:/a", "link",
          "up/secret", ".", "a%00b"}) {
        CAPTURE(reference);
        bool refused = false;
        try {
            resolve_inside(folder / "in", reference);
        } catch (const ReadError&) {
        } catch (const InputError&) {
            refused = true;
        }
        CHECK(refused);
    }
    CHECK_THROWS_AS(resolve_inside(folder / "in", "..\\secret", ReferenceSyntax::file_name), InputError);
    CHECK_THROWS_AS(resolve_inside(folder / "in", "none"), ReadError);
    CHECK(resolve_inside(folder / "in", "good").filename() == "a");
    // A folder whose name only has the name of the asset folder as a prefix is outside.
    fs::create_directory(folder / "inside");
    put(folder / "inside/a", "x");
    CHECK_THROWS_AS(resolve_inside(folder / "in", "../inside/a"), InputError);
}
