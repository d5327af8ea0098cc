#include <string>

#include "faqem/version.hpp"
#include "support/catch.hpp"

TEST_CASE("the version of the library equals that of its headers") {
    const std::string expected = std::to_string(faqem::version_major) + "." +
                                 std::to_string(faqem::version_minor) + "." +
                                 std::to_string(faqem::version_patch);
    CHECK(faqem::version() == expected);
}
