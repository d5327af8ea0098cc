#include "asset/io/file_finder.hpp"

#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

// The file that a reference finds, relative to the folder, with a `!` if it is not the named one; `-` for none.
std::string found(const TemporaryFolder& folder, const std::string& reference, const fs::path& subfolder = {},
                  ReferenceSyntax syntax = ReferenceSyntax::file_name) {
    FileFinder finder(folder / "in");
    try {
        const FoundFile file = finder.find(reference, subfolder, syntax);
        CHECK(file.file == fs::canonical(folder / "in" / file.name));
        return file.is_as_named ? file.name : "!" + file.name;
    } catch (const InputError&) {
        return "-";
    }
}

}  // namespace

TEST_CASE("files are found by the end of a path and by other letter case") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in/Tex");
    for (const char* name :
         {"in/my pic.png", "in/Tex/a.png", "in/Tex/B.PNG", "in/c.png", "in/C.png", "secret.png"})
        put(folder / name, name);
    CHECK(found(folder, "my pic.png") == "my pic.png");
    CHECK(found(folder, "\"my pic.png\"") == "my pic.png");
    CHECK(found(folder, "Tex\\a.png") == "Tex/a.png");
    CHECK(found(folder, "C:\\Users\\x\\My Pic.png") == "!my pic.png");
    CHECK(found(folder, "\"D:/x/my pic.png\"") == "!my pic.png");
    CHECK(found(folder, "/home/x/tex/b.png") == "!Tex/B.PNG");
    CHECK(found(folder, "TEX/A.PNG") == "!Tex/a.png");
    CHECK(found(folder, "A.png", "Tex") == "!Tex/a.png");
    CHECK(found(folder, "x/c.png", "Tex") == "!c.png");
    CHECK(found(folder, "x/C.PNG") == "!C.png");  // the first of two in the order of bytes
    CHECK(found(folder, "http://host/c.png") == "!c.png");
    CHECK(found(folder, "..\\..\\other\\c.png") == "!c.png");
    CHECK(found(folder, "a.png") == "-");
    CHECK(found(folder, "x/Tex") == "-");
    for (const std::string name : {"", "\"\"", "/", "..", "../secret.png", "x/../..", "c.png/x"})
        CHECK(found(folder, name) == "-");
}

TEST_CASE("URIs are percent-decoded before the search, and found as written and without a query, too") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in/Tex");
    for (const char* name : {"in/my pic.png", "in/Tex/a.png", "in/b%20c.png", "in/d?.png", "secret.png"})
        put(folder / name, name);
    const auto found_uri = [&](const std::string& uri) {
        return found(folder, uri, {}, ReferenceSyntax::uri);
    };
    CHECK(found_uri("my%20pic.png") == "my pic.png");
    CHECK(found_uri("Tex%2Fa.png") == "Tex/a.png");
    CHECK(found_uri("d?.png") == "d?.png");
    CHECK(found_uri("Tex\\a.png") == "!Tex/a.png");
    CHECK(found_uri("tex%5CA.PNG") == "!Tex/a.png");
    CHECK(found_uri("file:///C:/job/My%20Pic.png") == "!my pic.png");
    CHECK(found_uri("http://host/x/Tex/a.png?v=1#top") == "!Tex/a.png");
    CHECK(found_uri("b%20c.png") == "!b%20c.png");
    for (const char* uri :
         {"", "'my pic.png'", "%2e%2e/secret.png", "..%5Csecret.png", "file:///secret.png", "%00"})
        CHECK(found_uri(uri) == "-");
}

TEST_CASE("links to other folders are not followed") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in");
    put(folder / "secret.png", "secret");
    fs::create_symlink("../secret.png", folder / "in/link.png");
    fs::create_symlink("..", folder / "in/up");
    for (const char* name : {"link.png", "x/LINK.PNG", "up/secret.png", "x/UP/secret.png", "../secret.png"})
        CHECK(found(folder, name) == "-");
    CHECK(found(folder, (folder / "secret.png").string()) == "-");
}

TEST_CASE("long and strange references end in an error") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in");
    std::string deep;
    while (deep.size() < 100'000) deep += "a/";
    for (const std::string& name :
         {deep, std::string(100'000, 'x'), std::string("a\0b", 3), std::string("\xff/\xfe")})
        CHECK(found(folder, name) == "-");
    CHECK_THROWS_AS(FileFinder(folder / "missing").find("a.png"), InputError);
}

TEST_CASE("the files with an extension are listed in order") {
    const TemporaryFolder folder;
    for (const char* name : {"b.mtl", "A.MTL", "c.obj", ".mtl"}) put(folder / name, "");
    CHECK(FileFinder(folder.path()).files_with_extension(".mtl") ==
          std::vector<std::string>{"A.MTL", "b.mtl"});
}
