#include <cmath>
#include <limits>

#include "asset/text/text_scanner.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

TextScanner scanner(const std::string& text, Continuation continuation = Continuation::yes) {
    return TextScanner(bytes_of(text), "f", continuation);
}

}  // namespace

TEST_CASE("line ends LF, CR and CRLF give the same line numbers", "[text]") {
    for (const std::string end : {"\n", "\r", "\r\n"}) {
        const std::string text = "a" + end + end + "# c" + end + "b";
        TextScanner in = scanner(text);
        CHECK(in.word() == "a");
        CHECK(in.skip_to_content());
        CHECK(in.line() == 4);
        CHECK(in.word() == "b");
        CHECK(!in.skip_to_content());
    }
}

TEST_CASE("a byte order mark is skipped", "[text]") {
    const std::string text = "\xEF\xBB\xBFv";
    CHECK(scanner(text).word() == "v");
}

TEST_CASE("a backslash joins lines except in comments and in formats without continuation lines", "[text]") {
    const std::string text = "a \\\r\n b\\\nc # d \\\ne \\";
    TextScanner in = scanner(text);
    CHECK(in.word() == "a");
    CHECK(in.word() == "b");
    CHECK(in.word() == "c");
    CHECK(in.at_line_end());
    in.next_line();
    CHECK(in.line() == 4);
    CHECK(in.word() == "e");
    CHECK(in.word() == "\\");
    TextScanner plain = scanner(text, Continuation::no);
    plain.word();
    CHECK(plain.word() == "\\");
    CHECK(plain.at_line_end());
}

TEST_CASE("a number must extend to the last character of its word", "[text]") {
    const std::string text = "1 -2.5e3 +4 .5 5. 1e-3";
    TextScanner in = scanner(text);
    for (const double expected : {1.0, -2500.0, 4.0, 0.5, 5.0, 0.001}) CHECK(in.number<double>() == expected);
    for (const std::string bad : {"1,5", "1.2.3", "0x10", "abc", "", "--1", "+-1", "1e", "e5", "1f"}) {
        CAPTURE(bad);
        TextScanner wrong = scanner(bad);
        CHECK(contains(message_of([&] { wrong.number<double>(); }), "f: line 1: "));
    }
}

TEST_CASE("fractions and out-of-range values are not integers", "[text]") {
    for (const std::string bad : {"1.0", "1e3", "-1", "4294967296"}) {
        CAPTURE(bad);
        TextScanner in = scanner(bad);
        CHECK_THROWS_AS(in.number<std::uint32_t>(), InputError);
    }
    const std::string good = "4294967295";
    CHECK(scanner(good).number<std::uint32_t>() == 4294967295u);
}

TEST_CASE("infinities and NaN are read in all common spellings", "[text]") {
    const std::string nans = "nan NaN -nan nan(ind) 1.#QNAN -1.#IND 1.#SNAN";
    TextScanner in = scanner(nans);
    for (int i = 0; i < 7; ++i) CHECK(std::isnan(in.number<double>()));
    const std::string infinities = "inf -Infinity 1.#INF 1e400 -1e400";
    TextScanner more = scanner(infinities);
    for (int i = 0; i < 5; ++i) CHECK(std::isinf(more.number<double>()));
}

TEST_CASE("numbers below the range of their type are zero and subnormal numbers are kept", "[text]") {
    const std::string text = "1e-400 4.9406564584124654e-324 1e-50";
    TextScanner in = scanner(text);
    CHECK(in.number<double>() == 0);
    CHECK(in.number<double>() == std::numeric_limits<double>::denorm_min());
    CHECK(in.number<float>() == 0);
}

TEST_CASE("messages quote words without control characters and with limited length", "[text]") {
    const std::string text = std::string("x\x1b[31m") + std::string(1000, 'y');
    TextScanner in = scanner(text);
    const std::string message = message_of([&] { in.number<double>(); });
    CHECK(message.size() < 100);
    CHECK(message.find('\x1b') == std::string::npos);
}

TEST_CASE("numbers are written as the shortest text that reads back the same") {
    const auto text = [](auto value) {
        std::string written;
        append_number(written, value);
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
    append_line(text, "vt", std::array{0.5f, -1.0f});
    CHECK(text == "#\nvt 0.5 -1\n");
}
