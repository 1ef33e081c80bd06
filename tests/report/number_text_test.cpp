#include "report/page/number_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

namespace lancer {
namespace {

TEST(NumberText, SignificantDigitsKeepTheirZeros)
{
    EXPECT_EQ(significant(12.34), "12.3");
    EXPECT_EQ(significant(12), "12.0");
    EXPECT_EQ(significant(9.999), "10.0");
    EXPECT_EQ(significant(0.01234), "0.0123");
    EXPECT_EQ(significant(-123456), "-123456");
    EXPECT_EQ(significant(1234567), "1.23·10⁶");
    EXPECT_EQ(significant(-0.0001234, 2), "-1.2·10⁻⁴");
    EXPECT_EQ(significant(1.5e-300, 2), "1.5·10⁻³⁰⁰");
    EXPECT_EQ(significant(0), "0");
    EXPECT_EQ(significant(-0.0), "0");
    EXPECT_EQ(significant(NAN), "n/a");
    EXPECT_EQ(significant(-INFINITY), "n/a");
}

TEST(NumberText, RoundNumbersAreShort)
{
    EXPECT_EQ(round_text(0.5), "0.5");
    EXPECT_EQ(round_text(20), "20");
    EXPECT_EQ(round_text(3 * 0.1), "0.3");
    EXPECT_EQ(round_text(5000), "5000");
    EXPECT_EQ(round_text(10000), "10⁴");
    EXPECT_EQ(round_text(-20000), "-2·10⁴");
    EXPECT_EQ(round_text(2.5e-7), "2.5·10⁻⁷");
    EXPECT_EQ(round_text(0), "0");
}

TEST(NumberText, CountsAreWhole)
{
    EXPECT_EQ(count_text(0), "0");
    EXPECT_EQ(count_text(-0.0), "0");
    EXPECT_EQ(count_text(100000000), "100000000");
    EXPECT_EQ(count_text(2.5), "2.50");
    EXPECT_EQ(count_text(NAN), "n/a");
}

TEST(NumberText, TheLocaleDoesNotMatter)
{
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) std::setlocale(LC_ALL, name);
    EXPECT_EQ(significant(1.5), "1.50");
    EXPECT_EQ(fixed_text(2.25, 1), "2.2");
    std::setlocale(LC_ALL, before.c_str());
}

TEST(NumberText, EscapesWhatXmlWouldRead)
{
    EXPECT_EQ(escape_xml("a<b>&\"c\"'d'"), "a&lt;b&gt;&amp;&quot;c&quot;&#39;d&#39;");
    EXPECT_EQ(escape_xml("Größe 10⁶ 🐰\n\t"), "Größe 10⁶ 🐰\n\t");
    EXPECT_EQ(escape_xml(""), "");
}

TEST(NumberText, BytesThatAreNoTextAreReplaced)
{
    EXPECT_EQ(escape_xml(std::string("a\0b\x1b[1m\x7f", 8)), "a?b?[1m?");
    EXPECT_EQ(escape_xml("\xff\xfe"), "??");
    EXPECT_EQ(escape_xml("\xc3"), "?");                   // cut off
    EXPECT_EQ(escape_xml("\xc0\xbcscript"), "??script");  // '<' in two bytes
    EXPECT_EQ(escape_xml("\xe0\x80\xbc"), "???");         // and in three
    EXPECT_EQ(escape_xml("\xed\xa0\x80"), "???");         // half of a pair of UTF-16
    EXPECT_EQ(escape_xml("\xef\xbf\xbf"), "???");         // U+FFFF
    EXPECT_EQ(escape_xml("\xf5\x80\x80\x80"), "????");
}

}  // namespace
}  // namespace lancer
