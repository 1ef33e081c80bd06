#include "core/error.h"

#include <gtest/gtest.h>

namespace lancer {
namespace {

TEST(Error, TextNamesThePlace)
{
    const Error e(ErrorKind::invalid_input, {"a.toml", 12, 5}, "unknown key");
    EXPECT_STREQ(e.what(), "a.toml:12:5: error: unknown key");
    EXPECT_EQ(to_string(Location{"a.obj", 3, 0}), "a.obj:3");
    EXPECT_EQ(to_string(Location{"a.obj", 0, 7}), "a.obj");
}

TEST(Diagnostics, SameWarningIsCountedUnderItsFirstPlace)
{
    Diagnostics d;
    for (uint32_t line = 4; line < 9; ++line) d.warning({"a.obj", line, 0}, "zero-area face dropped");
    d.warning({"a.obj", 20, 0}, "zero-area face dropped", 7);
    ASSERT_EQ(d.warnings().size(), 1u);
    EXPECT_EQ(to_string(d.warnings()[0]), "a.obj:4: warning: zero-area face dropped (12 times)");
    d.warning({"b.obj", 1, 0}, "zero-area face dropped");
    ASSERT_EQ(d.warnings().size(), 1u);
    EXPECT_EQ(to_string(d.warnings()[0]), "a.obj:4: warning: zero-area face dropped (13 times, in 2 files)");
    EXPECT_NO_THROW(d.throw_if_errors());
}

TEST(Diagnostics, ProblemsOfManyNamesAreOne)
{
    const auto said = [](int names, uint64_t times) {
        Diagnostics d, rest;
        for (int i = 0; i < names; ++i)
            (i < 2 ? d : rest)
                .warning({"a.obj", 1 + static_cast<uint32_t>(i), 0}, NamedProblem{"no", std::to_string(i), " here"},
                         times);
        d.append(rest);
        d.append(rest);
        EXPECT_EQ(d.warnings().size(), 1u);
        return to_string(d.warnings()[0]);
    };
    EXPECT_EQ(said(1, 1), "a.obj:1: warning: no '0' here");
    EXPECT_EQ(said(1, 5), "a.obj:1: warning: no '0' here (5 times)");
    EXPECT_EQ(said(2, 1), "a.obj:1: warning: no '0' and '1' here");
    EXPECT_EQ(said(3, 1), "a.obj:1: warning: no '0', '1' and '2' here (4 times)");  // one of them twice
    EXPECT_EQ(said(4, 1), "a.obj:1: warning: no '0', '1', '2' and 1 other here (6 times)");
    EXPECT_EQ(said(9, 2), "a.obj:1: warning: no '0', '1', '2' and 6 others here (32 times)");
}

TEST(Diagnostics, AllErrorsAreThrownTogetherWithTheKindOfTheFirst)
{
    Diagnostics d;
    d.error({"a.toml", 1, 2}, "one", ErrorKind::missing_input);
    d.error({"a.toml", 3, 4}, "two");
    try {
        d.throw_if_errors();
        FAIL() << "nothing thrown";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::missing_input);
        EXPECT_STREQ(e.what(), "a.toml:1:2: error: one\na.toml:3:4: error: two");
    }
}

TEST(Diagnostics, AFloodOfErrorsIsCutAndCounted)
{
    Diagnostics d;
    for (int i = 0; i < 60; ++i) d.error({}, "bad");
    try {
        d.throw_if_errors();
        FAIL() << "nothing thrown";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("and 10 more"), std::string::npos);
    }
}

}  // namespace
}  // namespace lancer
