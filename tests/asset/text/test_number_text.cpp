#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "asset/text/number_text.hpp"
#include "support/catch.hpp"

TEST_CASE("numbers are written as the shortest text that reads back the same") {
    const auto text = [](auto value) {
        std::string written;
        faqem::detail::append_number(written, value);
        return written;
    };
    CHECK(text(0.1f) == "0.1");
    CHECK(text(0.1) == "0.1");
    CHECK(text(static_cast<double>(0.1f)) == "0.10000000149011612");
    CHECK(text(-std::numeric_limits<double>::max()) == "-1.7976931348623157e+308");
    CHECK(text(std::numeric_limits<std::uint64_t>::max()) == "18446744073709551615");
}

TEST_CASE("a line has a blank before each number") {
    std::string text = "#\n";
    faqem::detail::append_line(text, "vt", std::array{0.5f, -1.0f});
    CHECK(text == "#\nvt 0.5 -1\n");
}
