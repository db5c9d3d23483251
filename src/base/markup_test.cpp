#include "linewright/base/markup.hpp"

#include <gtest/gtest.h>

#include <string>

namespace linewright::markup {
namespace {

const std::string kUnknown = "\xEF\xBF\xBD";

TEST(Escaped, LeavesPlainTextAlone) {
  EXPECT_EQ(escaped("flange_side → ticks 1–13 · 部品 🤖"),
            "flange_side → ticks 1–13 · 部品 🤖");
}

TEST(Escaped, WritesMarkupAsEntities) {
  EXPECT_EQ(escaped("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
}

TEST(Escaped, ReplacesWhatXmlCannotHold) {
  EXPECT_EQ(escaped(std::string("a\0b\x1b", 4)), "a" + kUnknown + "b" + kUnknown);
  EXPECT_EQ(escaped("a\tb\nc"), "a b c");
  EXPECT_EQ(escaped("\xEF\xBF\xBE\xEF\xBF\xBF"), kUnknown + kUnknown);
}

TEST(Escaped, ReplacesBrokenUtf8) {
  EXPECT_EQ(escaped("\x80"), kUnknown);
  EXPECT_EQ(escaped("\xC3"), kUnknown);
  EXPECT_EQ(escaped("\xC0\xAF"), kUnknown + kUnknown);                 // overlong
  EXPECT_EQ(escaped("\xED\xA0\x80"), kUnknown + kUnknown + kUnknown);  // surrogate
  EXPECT_EQ(escaped("\xE2\x86x"), kUnknown + kUnknown + "x");
}

TEST(Shortened, KeepsWholeCharacters) {
  EXPECT_EQ(shortened("weld", 100.0, 10.0), "weld");
  EXPECT_EQ(shortened("部品部品部品", 40.0, 10.0), "部品…");
}

TEST(Coordinate, HasNoNeedlessZeros) {
  EXPECT_EQ(coordinate(12.0), "12");
  EXPECT_EQ(coordinate(12.5), "12.5");
  EXPECT_EQ(coordinate(-0.001), "0");
  EXPECT_EQ(coordinate(100.126), "100.13");
}

}  // namespace
}  // namespace linewright::markup
