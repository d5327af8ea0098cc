#include "asset/io/recovery.hpp"

#include <fcntl.h>

#include <map>

#include "asset/io/file.hpp"
#include "asset/io/file_set.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;
namespace fs = std::filesystem;

namespace {

ContentStamp stamp(const std::string& text) {
    ContentHash hash;
    hash.add(bytes_of(text));
    return {text.size(), hash.value()};
}

std::map<std::string, std::string> folder_contents(const TemporaryFolder& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        files[entry.path().filename()] = get(entry.path());
    return files;
}

/// A set of a.bin, which replaces a file, and a.gltf, which is new, as a dead process may leave it.
struct DeadSet {
    DeadSet() {
        entries[0] = {"aaaaaaaaaaaaaaaaaaaaaaaa", "a.bin", stamp("new bin"), stamp("old bin")};
        entries[1] = {"bbbbbbbbbbbbbbbbbbbbbbbb", "a.gltf", stamp("new gltf"), std::nullopt};
        put(folder / entries[0].backup_name(), "old bin");
        put(folder / journal_name, journal_text(entries));
    }

    std::string bin_temporary() const { return entries[0].temporary_name(); }
    std::string gltf_temporary() const { return entries[1].temporary_name(); }
    std::string bin_backup() const { return entries[0].backup_name(); }

    TemporaryFolder folder;
    JournalEntry entries[2];
};

using Files = std::map<std::string, std::string>;
const Files new_set = {{"a.bin", "new bin"}, {"a.gltf", "new gltf"}}, old_set = {{"a.bin", "old bin"}};

}  // namespace

TEST_CASE("a set is completed from any state between the renames", "[recovery]") {
    for (int renamed = 0; renamed < 4; ++renamed) {
        CAPTURE(renamed);
        const DeadSet set;
        put(set.folder / (renamed & 1 ? "a.bin" : set.bin_temporary()), "new bin");
        if (!(renamed & 1)) put(set.folder / "a.bin", "old bin");
        put(set.folder / (renamed & 2 ? "a.gltf" : set.gltf_temporary()), "new gltf");
        recover_folder(set.folder.path());
        CHECK(folder_contents(set.folder) == new_set);
    }
}

TEST_CASE("a set that cannot be completed is restored", "[recovery]") {
    for (const std::string& damaged : {std::string(), std::string("new glt")}) {
        const DeadSet set;
        put(set.folder / "a.bin", "new bin");
        if (!damaged.empty()) put(set.folder / set.gltf_temporary(), damaged);
        recover_folder(set.folder.path());
        CHECK(folder_contents(set.folder) == old_set);
    }
    const DeadSet set;  // a new file is removed
    put(set.folder / "a.bin", "old bin");
    put(set.folder / "a.gltf", "new gltf");
    fs::remove(set.folder / set.bin_backup());
    recover_folder(set.folder.path());
    CHECK(folder_contents(set.folder) == old_set);
}

TEST_CASE("files that were changed since are not touched", "[recovery]") {
    const auto check_refused = [](const DeadSet& set, const std::string& name) {
        const auto before = folder_contents(set.folder);
        const std::string message = message_of<WriteError>([&] { recover_folder(set.folder.path()); });
        CHECK(contains(message, name + ": belongs to a set of files"));
        CHECK(contains(message, "then delete " + (set.folder / journal_name).string()));
        CHECK(folder_contents(set.folder) == before);
        CHECK_THROWS_AS(write_file(set.folder / "b", bytes_of("x"), Overwrite::no), WriteError);
        CHECK_THROWS_AS(check_completely_replaced(set.folder / "a.bin"), ReadError);
    };
    const DeadSet edited;
    put(edited.folder / "a.bin", "edited!");
    put(edited.folder / edited.gltf_temporary(), "new gltf");
    check_refused(edited, "a.bin");

    const DeadSet created;
    put(created.folder / "a.bin", "new bin");
    put(created.folder / "a.gltf", "by another program");
    check_refused(created, "a.gltf");
}

TEST_CASE("links are neither followed nor replaced by recovery", "[recovery]") {
    const TemporaryFolder outside;
    put(outside / "secret", "old bin");
    const DeadSet set;
    put(set.folder / set.bin_temporary(), "new bin");
    put(set.folder / set.gltf_temporary(), "new gltf");
    fs::create_symlink(outside / "secret", set.folder / "a.bin");
    CHECK_THROWS_AS(recover_folder(set.folder.path()), WriteError);
    CHECK(get(outside / "secret") == "old bin");
    CHECK(fs::is_symlink(set.folder / "a.bin"));
}

TEST_CASE("an invalid journal is removed with its leftovers, and a locked one is left alone", "[recovery]") {
    const DeadSet set;
    put(set.folder / "a.bin", "old bin");
    put(set.folder / set.bin_temporary(), "new bin");
    put(set.folder / set.gltf_temporary(), "new gltf");
    const auto before = folder_contents(set.folder);
    {
        const Descriptor journal(::open((set.folder / journal_name).c_str(), O_RDONLY));
        REQUIRE(try_lock(journal.get()) == Lock::acquired);
        recover_folder(set.folder.path());
        CHECK(folder_contents(set.folder) == before);
        check_completely_replaced(set.folder / "a.bin");
    }
    const std::string text = get(set.folder / journal_name);
    put(set.folder / journal_name, text.substr(0, text.size() / 2));
    check_completely_replaced(set.folder / "a.bin");
    recover_folder(set.folder.path());
    CHECK(folder_contents(set.folder) == old_set);
}

TEST_CASE("files of a half replaced set are not read until a write completes it", "[recovery]") {
    const DeadSet set;
    put(set.folder / "a.bin", "new bin");
    put(set.folder / set.gltf_temporary(), "new gltf");
    put(set.folder / "other", "other");
    fs::create_symlink("a.bin", set.folder / "link");
    for (const char* name : {"a.bin", "a.gltf", "link"}) {
        const std::string message = message_of<ReadError>([&] { read_file(set.folder / name); });
        CHECK(contains(message, (set.folder / name).string() + ": belongs to a set of files"));
        CHECK(contains(message, "that writes to the folder " + fs::canonical(set.folder.path()).string()));
    }
    CHECK(read_file(set.folder / "other").size() == 5);
    write_file(set.folder / "other", bytes_of("new"), Overwrite::yes);
    for (const char* name : {"a.bin", "a.gltf", "link"}) CHECK(!read_file(set.folder / name).empty());
}
