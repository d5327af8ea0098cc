#include <cstdint>
#include <limits>
#include <string>

#include "asset/text/text_buffer.hpp"
#include "support/catch.hpp"

using faqem::detail::TextBuffer;

TEST_CASE("a text buffer returns the appended text for any size") {
    TextBuffer buffer;
    CHECK(buffer.view().empty());
    buffer.put("");
    CHECK(buffer.size() == 0);
    std::string expected;
    for (int i = 0; i < 20000; ++i) {
        buffer.put('v');
        buffer.put_number(i - 10000);
        buffer.put(" word\n");
        expected += 'v';
        expected += std::to_string(i - 10000);
        expected += " word\n";
    }
    CHECK(buffer.view() == expected);
    CHECK(buffer.size() == expected.size());
}

TEST_CASE("a text buffer writes the shortest numbers that read back the same") {
    const auto text = [](auto value) {
        TextBuffer buffer;
        buffer.put_number(value);
        return std::string(buffer.view());
    };
    CHECK(text(0.1f) == "0.1");
    CHECK(text(0.1) == "0.1");
    CHECK(text(static_cast<double>(0.1f)) == "0.10000000149011612");
    CHECK(text(-std::numeric_limits<double>::max()) == "-1.7976931348623157e+308");
    CHECK(text(std::numeric_limits<std::uint64_t>::max()) == "18446744073709551615");
}
