#include "cli/files/sha256.hpp"

#include <string>

#include "support/catch.hpp"

using namespace faqem::cli;

TEST_CASE("SHA-256 has the digests of FIPS 180-4") {
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(sha256(std::string(1'000'000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("SHA-256 does not depend on the pieces in which bytes are added") {
    const std::string bytes(200, '\7');
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        Sha256 pieces;
        pieces.add(bytes.substr(0, size));
        pieces.add(bytes.substr(size));
        Sha256 whole;
        whole.add(bytes);
        CHECK(pieces.finish() == whole.finish());
    }
}
