#include "cli/report/html.hpp"

#include "support/catch.hpp"

using namespace faqem::cli;

TEST_CASE("escape_html escapes the special characters of HTML") {
    CHECK(escape_html("a<b> & \"c\" 'd'") == "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
    CHECK(escape_html("plain größe") == "plain größe");
}

TEST_CASE("fill_template replaces placeholders, but not inside values") {
    CHECK(fill_template("x @@A@@ y @@B_2@@", {{"A", "@@B_2@@"}, {"B_2", "2"}}) == "x @@B_2@@ y 2");
    CHECK(fill_template("@media a@b @@A@@ @", {{"A", ""}}) == "@media a@b  @");
    CHECK(fill_template("", {}).empty());
}

TEST_CASE("html_table writes header cells for the first row and column and escapes all cells") {
    CHECK(html_table("c<", {"", "t<"}, {{"r", "<1"}}) ==
          "<div><table>\n<caption>c&lt;</caption>\n<thead><tr><td></td><th "
          "scope=\"col\">t&lt;</th></tr></thead>\n"
          "<tbody>\n<tr><th scope=\"row\">r</th><td>&lt;1</td></tr>\n</tbody>\n</table></div>\n");
}

TEST_CASE("base64 encodes the test vectors of RFC 4648") {
    const auto coded = [](std::string_view text) {
        return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    CHECK(coded("").empty());
    CHECK(coded("f") == "Zg==");
    CHECK(coded("fo") == "Zm8=");
    CHECK(coded("foo") == "Zm9v");
    CHECK(coded("foob") == "Zm9vYg==");
    CHECK(coded("fooba") == "Zm9vYmE=");
    CHECK(coded("foobar") == "Zm9vYmFy");
    CHECK(coded("\xfb\xff\xfe") == "+//+");
}
