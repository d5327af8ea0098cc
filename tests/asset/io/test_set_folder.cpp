#include "asset/io/set_folder.hpp"

#include <chrono>

#include "asset/io/file.hpp"
#include "asset/io/file_set.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

/// A set of a.bin, which replaces a file, and a.gltf, which is new, as a process leaves it that dies before the first
/// file is renamed to its place.
struct DeadSet {
    DeadSet() {
        fs::create_directories(at("old/a.gltf"));
        fs::create_directory(at("new"));
        put(folder / "a.bin", "old bin");
        fs::create_hard_link(folder / "a.bin", at("old/a.bin"));
        put(at("new/a.bin"), "new bin");
        put(at("new/a.gltf"), "new gltf");
    }

    fs::path at(const std::string& name) const { return folder / set_folder_name / name; }
    void rename(const std::string& name) const { fs::rename(at("new/" + name), folder / name); }
    void recover() const { recover_folder(folder.path()); }

    TemporaryFolder folder;
};

const Texts new_set = {{"a.bin", "new bin"}, {"a.gltf", "new gltf"}}, old_set = {{"a.bin", "old bin"}};

}  // namespace

TEST_CASE("a set is completed from any state between the renames", "[set_folder]") {
    for (int renamed = 0; renamed < 4; ++renamed) {
        CAPTURE(renamed);
        const DeadSet set;
        if (renamed & 1) set.rename("a.bin");
        if (renamed & 2) set.rename("a.gltf");
        set.recover();
        CHECK(texts_in(set.folder.path()) == new_set);
        CHECK(!fs::exists(set.at("")));
    }
}

TEST_CASE("a set whose files were not complete is removed", "[set_folder]") {
    const DeadSet set;
    fs::rename(set.at("new"), set.at("staged"));
    check_completely_replaced(set.folder / "a.bin");
    set.recover();
    CHECK(texts_in(set.folder.path()) == old_set);
    CHECK(!fs::exists(set.at("")));
}

TEST_CASE("files that were changed since are not touched", "[set_folder]") {
    const auto check_refused = [](const DeadSet& set, const std::string& name) {
        const Texts before = texts_in(set.folder.path());
        const std::string message = message_of<WriteError>([&] { set.recover(); });
        CHECK(contains(message, name + ": belongs to a set of files"));
        CHECK(contains(message, "then delete " + (set.folder / set_folder_name).string()));
        Texts after = texts_in(set.folder.path());
        after.erase(".faqem-set/lock");
        CHECK(after == before);
        CHECK_THROWS_AS(write_file(set.folder / "b", bytes_of("x"), Overwrite::no), WriteError);
        CHECK_THROWS_AS(check_completely_replaced(set.folder / "a.bin"), ReadError);
    };
    const auto now = fs::file_time_type::clock::now();
    const DeadSet edited;
    put(edited.folder / "a.bin", "edited!");  // of the same size, and in old/, too
    fs::last_write_time(edited.folder / "a.bin", now + std::chrono::seconds(1));
    check_refused(edited, "a.bin");

    const DeadSet replaced;
    put(replaced.folder / "other", "replaced");
    fs::last_write_time(replaced.folder / "other", now - std::chrono::hours(1));
    fs::rename(replaced.folder / "other", replaced.folder / "a.bin");
    check_refused(replaced, "a.bin");

    const DeadSet created;
    created.rename("a.bin");
    put(created.folder / "a.gltf", "by another program");
    check_refused(created, "a.gltf");
}

TEST_CASE("links are neither followed nor replaced by recovery", "[set_folder]") {
    const TemporaryFolder outside;
    put(outside / "secret", "old bin");
    const auto check_refused = [&](const DeadSet& set, const fs::path& link, const fs::path& target) {
        fs::remove_all(link);
        fs::create_symlink(target, link);
        CHECK_THROWS_AS(set.recover(), WriteError);
        CHECK(texts_in(outside.path()) == Texts{{"secret", "old bin"}});
        CHECK(fs::is_symlink(link));
    };
    const DeadSet sets[4];
    check_refused(sets[0], sets[0].folder / "a.bin", outside / "secret");
    check_refused(sets[1], sets[1].at("new/a.bin"), outside / "secret");
    check_refused(sets[2], sets[2].at("new"), outside.path());
    check_refused(sets[3], sets[3].folder / set_folder_name, outside.path());
    put(sets[3].folder / "file", "");
    fs::rename(sets[3].folder / "file", sets[3].folder / set_folder_name);
    CHECK(contains(message_of<WriteError>([&] { sets[3].recover(); }), "is not a folder; remove it"));
}

TEST_CASE("a set is locked by one process at a time, and left alone by others", "[set_folder]") {
    const TemporaryFolder empty;
    Lock lock = Lock::held;
    CHECK(!lock_set_folder(empty.path(), MissingSet::ignore, lock));
    CHECK(lock == Lock::acquired);
    const DeadSet set;
    {
        const auto locked = lock_set_folder(set.folder.path(), MissingSet::create, lock);
        REQUIRE(locked);
        CHECK(!lock_set_folder(set.folder.path(), MissingSet::create, lock));
        CHECK(lock == Lock::held);
        set.recover();
        check_completely_replaced(set.folder / "a.bin");
        CHECK(fs::exists(set.at("new/a.bin")));
    }
    set.recover();
    CHECK(texts_in(set.folder.path()) == new_set);
}

TEST_CASE("files of a half replaced set are not read until a write completes it", "[set_folder]") {
    const DeadSet set;
    set.rename("a.gltf");
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
