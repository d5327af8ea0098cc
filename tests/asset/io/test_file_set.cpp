#include "asset/io/file_set.hpp"

#include <sys/stat.h>

#include <csignal>
#include <thread>

#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

void add_texts(FileSet& set, const TemporaryFolder& folder, const Texts& texts,
               Overwrite overwrite = Overwrite::yes) {
    std::vector<FileContent> files;
    for (const auto& [name, text] : texts) files.push_back({folder / name, bytes_of(text)});
    set.add(files, overwrite);
}

int pending_terms = 0;

}  // namespace

TEST_CASE("a set keeps its files until it is committed, and then replaces all", "[file_set]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    const Texts old = {{"a", "old a"}, {"sub/b", "old b"}}, all = {{"a", "1"}, {"c", "3"}, {"sub/b", "2"}};
    for (const auto& [name, text] : old) put(folder / name, text);
    {
        FileSet set;
        add_texts(set, folder, all);
        CHECK(get(folder / "a") == "old a");
    }
    CHECK(texts_in(folder.path()) == old);
    FileSet set;
    add_texts(set, folder, all);
    set.commit();
    CHECK(texts_in(folder.path()) == all);
    set.commit();  // empty
    CHECK(texts_in(folder.path()) == all);
}

TEST_CASE("writes of a thread are collected in a set", "[file_set]") {
    const TemporaryFolder folder;
    FileSet set;
    {
        const CollectWrites collect(set);
        write_file(folder / "a", bytes_of("1"), Overwrite::no);
        write_file(folder / "b", bytes_of("2"), Overwrite::no);
        std::thread([&] { write_file(folder / "c", bytes_of("3"), Overwrite::no); }).join();
    }
    CHECK(!fs::exists(folder / "a"));
    CHECK(get(folder / "c") == "3");
    set.commit();
    CHECK(texts_in(folder.path()) == Texts{{"a", "1"}, {"b", "2"}, {"c", "3"}});
}

TEST_CASE("a file that is created before the commit is not replaced, and neither are the others",
          "[file_set]") {
    const TemporaryFolder folder;
    put(folder / "sub", "");
    FileSet set;
    add_texts(set, folder, {{"a", "1"}, {"b", "2"}}, Overwrite::no);
    put(folder / "b", "other");
    CHECK(contains(message_of<WriteError>([&] { set.commit(); }), "b: cannot write: File exists"));
    CHECK(!fs::exists(folder / "a"));
    CHECK(get(folder / "b") == "other");
}

TEST_CASE("permissions and links are kept by a set", "[file_set]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    put(folder / "sub/real", "old");
    REQUIRE(::chmod((folder / "sub/real").c_str(), 0604) == 0);
    fs::create_symlink("sub/real", folder / "link");
    FileSet set;
    add_texts(set, folder, {{"a", "1"}, {"link", "2"}});
    set.commit();
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(get(folder / "sub/real") == "2");
    CHECK(static_cast<unsigned>(fs::status(folder / "sub/real").permissions()) == 0604);
    CHECK(texts_in(folder.path()).size() == 3);
}

TEST_CASE("a name that occurs twice in a set is an error", "[file_set]") {
    const TemporaryFolder folder;
    put(folder / "a", "old");
    fs::create_symlink("a", folder / "link");
    FileSet set;
    add_texts(set, folder, {{"a", "1"}});
    CHECK(contains(message_of<WriteError>([&] {
                       add_texts(set, folder, {{"a", "2"}});
                   }),
                   "name of two files"));
    CHECK(contains(message_of<WriteError>([&] {
                       add_texts(set, folder, {{"link", "2"}});
                   }),
                   "name of two files"));
}

TEST_CASE("sets of several writers do not mix", "[file_set]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    std::vector<std::thread> writers;
    for (int i = 0; i < 6; ++i)
        writers.emplace_back([&, i] {
            for (int round = 0; round < 5; ++round) {
                const std::string text = std::to_string(i) + " " + std::to_string(round);
                FileSet set;
                // The folders are named in both orders.
                add_texts(set, folder, {{i % 2 ? "a" : "sub/c", text}});
                add_texts(set, folder, {{i % 2 ? "sub/c" : "a", text}, {"b", text}});
                set.commit();
            }
        });
    for (std::thread& writer : writers) writer.join();
    const Texts texts = texts_in(folder.path());
    CHECK(texts.size() == 3);
    CHECK(texts.at("a") == texts.at("b"));
    CHECK(texts.at("a") == texts.at("sub/c"));
}

TEST_CASE("signals are held until a set is complete", "[file_set]") {
    const TemporaryFolder folder;
    FileSet set;
    add_texts(set, folder, {{"a", "1"}, {"b", "2"}});
    pending_terms = 0;
    auto* const before = std::signal(SIGTERM, [](int) { ++pending_terms; });
    static int seen_in_commit;
    seen_in_commit = -1;
    set.commit([]() noexcept {
        ::raise(SIGTERM);
        seen_in_commit = pending_terms;
    });
    std::signal(SIGTERM, before);
    CHECK(seen_in_commit == 0);
    CHECK(pending_terms == 1);
    CHECK(texts_in(folder.path()).size() == 2);
}
