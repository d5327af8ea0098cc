#include "asset/io/temporary_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <set>

#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

std::set<std::string> file_names(const TemporaryFolder& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path())) names.insert(entry.path().filename());
    return names;
}

const std::string leftover = ".faqem-0123456789abcdef01234567.tmp";

}  // namespace

TEST_CASE("leftovers without a lock are removed, other files are kept", "[temporary_file]") {
    const TemporaryFolder folder;
    put(folder / leftover, "left");
    const std::set<std::string> others = {
        ".faqem-0123456789abcdef0123456.tmp",  ".faqem-0123456789abcdef01234567.tmp2",
        ".faqem-0123456789ABCDEF01234567.tmp", ".faqem-batch.jsonl",
        "0123456789abcdef01234567.tmp",        "a.glb"};
    for (const std::string& name : others) put(folder / name, "kept");
    remove_leftovers(folder.path());
    CHECK(file_names(folder) == others);
    remove_leftovers(folder / "none");
}

TEST_CASE("links, folders and pipes with the name of a temporary file are kept", "[temporary_file]") {
    const TemporaryFolder folder;
    put(folder / "a", "kept");
    const std::string end = "bcdef0123456789abcdef01.tmp";
    fs::create_symlink("a", folder / (".faqem-0" + end));
    fs::create_directory(folder / (".faqem-1" + end));
    REQUIRE(::mkfifo((folder / (".faqem-2" + end)).c_str(), 0600) == 0);
    REQUIRE(is_temporary_name(".faqem-0" + end));
    const auto before = file_names(folder);
    remove_leftovers(folder.path());
    CHECK(file_names(folder) == before);
    CHECK(get(folder / "a") == "kept");
}

TEST_CASE("a temporary file is locked while it exists", "[temporary_file]") {
    const TemporaryFolder folder;
    {
        const TemporaryFile file(folder / "a", 0666);
        CHECK(is_temporary_name(fs::path(file.name()).filename().string()));
        const Descriptor other(::open(file.name(), O_RDONLY));
        CHECK(try_lock(other.get()) == Lock::held);
        remove_leftovers(folder.path());
        CHECK(file_names(folder).size() == 1);
    }
    CHECK(file_names(folder).empty());
}

TEST_CASE("the lock of a temporary file ends with its process", "[temporary_file]") {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const TemporaryFile file(folder / "a", 0666);
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    CHECK(file_names(folder).size() == 1);
    remove_leftovers(folder.path());
    CHECK(file_names(folder).empty());
}

TEST_CASE("more temporary files than one block of slots can exist and are removed", "[temporary_file]") {
    const TemporaryFolder folder;
    const pid_t child = ::fork();  // remove_temporary_files() is called by processes that end
    REQUIRE(child >= 0);
    if (child == 0) {
        std::vector<TemporaryFile> files;
        for (int i = 0; i < 150; ++i) files.emplace_back(folder / "a", 0666);
        bool passed = file_names(folder).size() == 150 && remove_temporary_files();
        for (const TemporaryFile& file : files) passed &= file.is_removed();
        ::_exit(passed ? 0 : 1);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
    CHECK(file_names(folder).empty());
}
