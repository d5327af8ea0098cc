#include "asset/io/journal.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;
namespace fs = std::filesystem;

namespace {

const std::string id_a = "0123456789abcdef01234567", id_b = "76543210fedcba9876543210";

std::vector<JournalEntry> two_entries() {
    return {{id_a, "a_0.png", {3, 0x1234}, std::nullopt}, {id_b, "a.gltf", {0, ~0ull}, ContentStamp{7, 1}}};
}

/// Whether a journal with the name as its only file is accepted.
bool is_accepted(const std::string& name) {
    const JournalEntry entry = {id_a, name, {}, {}};
    return parse_journal(journal_text({&entry, 1})).has_value();
}

}  // namespace

TEST_CASE("the hash of contents is FNV-1a with 64 bits", "[journal]") {
    const auto hash = [](const std::string& text) {
        ContentHash all, parts;
        all.add(bytes_of(text));
        for (const char& c : text) parts.add(bytes_of({&c, 1}));
        CHECK(all.value() == parts.value());
        return all.value();
    };
    // http://www.isthe.com/chongo/tech/comp/fnv, test vectors
    CHECK(hash("") == 0xcbf29ce484222325u);
    CHECK(hash("a") == 0xaf63dc4c8601ec8cu);
    CHECK(hash("foobar") == 0x85944171f73967e8u);
}

TEST_CASE("a journal is read as it was written", "[journal]") {
    CHECK(parse_journal(journal_text(two_entries())) == two_entries());
    for (const char* name : {"with blank", "line\nend", "100%", "\xFF\x80", "-", ".hidden", "a\\b"}) {
        CAPTURE(name);
        CHECK(is_accepted(name));
    }
}

TEST_CASE("a journal that is truncated or changed at any byte is invalid", "[journal]") {
    const std::string text = journal_text(two_entries());
    for (std::size_t i = 0; i < text.size(); ++i) {
        CHECK(!parse_journal(text.substr(0, i)));
        std::string changed = text;
        changed[i] ^= 1;
        CHECK(!parse_journal(changed));
    }
    CHECK(!parse_journal(text + "\n"));
    CHECK(!parse_journal(journal_text({})));  // without files
}

TEST_CASE("a journal names plain files of its folder only, each once", "[journal]") {
    for (const std::string& name :
         {std::string(), std::string("."), std::string(".."), std::string("../a"), std::string("/etc/passwd"),
          std::string("sub/a"), std::string("a\0b", 3), ".faqem-" + id_a + ".tmp", std::string(journal_name),
          std::string(".faqem-batch.jsonl"), std::string(256, 'a')}) {
        CAPTURE(name);
        CHECK(!is_accepted(name));
    }
    for (const char* id : {"../../../../../../../aaa", "0123456789ABCDEF01234567", "0"}) {
        const JournalEntry entry = {id, "a", {}, {}};
        CHECK(!parse_journal(journal_text({&entry, 1})));
    }
    std::vector<JournalEntry> same_name = two_entries(), same_id = two_entries();
    same_name[1].name = same_name[0].name;
    same_id[1].id = same_id[0].id;
    CHECK(!parse_journal(journal_text(same_name)));
    CHECK(!parse_journal(journal_text(same_id)));
}

TEST_CASE("a journal is locked by one process at a time and never followed as a link", "[journal]") {
    const TemporaryFolder folder;
    Lock lock = Lock::held;
    CHECK(!open_journal(folder.path(), MissingJournal::ignore, lock));
    CHECK(lock == Lock::acquired);
    {
        const auto journal = open_journal(folder.path(), MissingJournal::create, lock);
        REQUIRE(journal);
        CHECK(!open_journal(folder.path(), MissingJournal::create, lock));
        CHECK(lock == Lock::held);
        remove_journal(*journal);
    }
    CHECK(fs::is_empty(folder.path()));
    put(folder / "precious", "text");
    fs::create_symlink("precious", folder / journal_name);
    CHECK(contains(message_of<WriteError>([&] { open_journal(folder.path(), MissingJournal::create, lock); }),
                   "is not a regular file; remove it"));
    fs::remove(folder / journal_name);
    REQUIRE(::mkfifo((folder / journal_name).c_str(), 0600) == 0);
    CHECK(contains(message_of<WriteError>([&] { open_journal(folder.path(), MissingJournal::ignore, lock); }),
                   "is not a regular file; remove it"));
    CHECK(get(folder / "precious") == "text");
}
