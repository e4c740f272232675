#include "core/text.hpp"

#include <gtest/gtest.h>

#include "tests/support/hostile_names.hpp"

namespace drape {
namespace {

const std::string mark = "\xEF\xBF\xBD";  // U+FFFD

TEST(Printable, KeepsUtf8) {
  for (const char* text :
       {"", "plain\ttext\n", "Tücher", "布 ∇g 🧵", "\xC2\xA0", "\xEF\xBF\xBD", "\xF4\x8F\xBF\xBD"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printable("\xFF"), mark);
  EXPECT_EQ(printable("a\xE4z"), "a" + mark + "z");  // Latin-1
  EXPECT_EQ(printable("\xC3"), mark);                // cut off
  EXPECT_EQ(printable("\xE2\x82"), mark + mark);     // cut off
  EXPECT_EQ(printable("\xC0\xAF"), mark + mark);     // "/" in two bytes
  EXPECT_EQ(printable("\xE0\x80\xAF"), mark + mark + mark);
  EXPECT_EQ(printable("\xED\xA0\x80"), mark + mark + mark);             // half of a surrogate pair
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), mark + mark + mark + mark);  // beyond U+10FFFF
  EXPECT_EQ(printable("\xF8\x88\x80\x80\x80"), mark + mark + mark + mark + mark);
}

TEST(Printable, ReplacesWhatNoPageMayHold) {
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a" + mark + "b");
  EXPECT_EQ(printable("\x1B[31m\x7F\r"), mark + "[31m" + mark + mark);
  EXPECT_EQ(printable("\xC2\x85"), mark + mark);             // U+0085, a control character
  EXPECT_EQ(printable("\xEF\xBF\xBF"), mark + mark + mark);  // U+FFFF, a noncharacter
}

TEST(Printable, ReplacesWhatTurnsTheDirectionOfWriting) {
  EXPECT_EQ(printable("a\u202Egpj"), "a" + mark + mark + mark + "gpj");
  EXPECT_EQ(printable("שלום عربي"), "שלום عربي");
}

TEST(EscapeControls, WritesWhatTalksToATerminal) {
  EXPECT_EQ(escape_controls("a\x1b[31m\x7f\tb\r"), "a\\x1b[31m\\x7f\\x09b\\x0d");
  EXPECT_EQ(escape_controls(std::string("\0", 1)), "\\x00");
  EXPECT_EQ(escape_controls("\xc2\x9b\xff"), "\\x9b\\xff");
  EXPECT_EQ(escape_controls("a\u202Egpj\u2028"), "a\\u202egpj\\u2028");
  EXPECT_EQ(escape_controls("line\nfeed, Tücher, 布"), "line\nfeed, Tücher, 布");
}

TEST(EscapeControls, LeavesNoCommandToABuildServer) {
  EXPECT_EQ(escape_controls("a\n ::error::b"), "a\n \\x3a:error::b");
  EXPECT_EQ(escape_controls("::error::b"), "\\x3a:error::b");
  EXPECT_EQ(escape_controls("std::string ##[group] ##vso[x] ##"), "std::string \\x23#[group] \\x23#vso[x] ##");
}

TEST(EscapeControls, ShowsANameOnOneLine) {
  EXPECT_EQ(shown(std::string("a\nb")), "a\\x0ab");
  EXPECT_EQ(shown(std::filesystem::path("a/b\n::c")), "a/b\\x0a\\x3a:c");
  for (const std::string& name : test::hostile_names) {
    EXPECT_FALSE(test::has_controls(shown(name))) << name;
    EXPECT_EQ(shown(shown(name)), shown(name));
    EXPECT_EQ(shown(name).find('\n'), std::string::npos);
  }
}

TEST(ReadableLength, HasThreeDigitsAndTheUnitInWhichOneReadsThem) {
  EXPECT_EQ(readable_length(0), "0");
  EXPECT_EQ(readable_length(12.345), "12.3 m");
  EXPECT_EQ(readable_length(0.4), "400 mm");
  EXPECT_EQ(readable_length(1e-3), "1 mm");
  EXPECT_EQ(readable_length(1e-4), "0.1 mm");
  EXPECT_EQ(readable_length(1e-5), "10 µm");
  EXPECT_EQ(readable_length(3.4e-8), "34 nm");
  EXPECT_EQ(readable_length(1 / 0.0), "not finite");
}

TEST(ReadableLength, TakesTheUnitOfTheRoundedNumber) {
  EXPECT_EQ(readable_length(0.9996), "1 m");
  EXPECT_EQ(readable_length(0.9994), "999 mm");
  EXPECT_EQ(readable_length(0.9996e-6), "1 µm");
}

TEST(ReadableTime, TellsNeighbouringFramesApart) {
  EXPECT_EQ(readable_time(0.284, 0.002), "0.284 s");
  EXPECT_EQ(readable_time(0.28, 0.04), "0.28 s");
  EXPECT_EQ(readable_time(3, 2), "3.00 s");
  EXPECT_EQ(readable_time(0.25, 0.05 - 0.04), "0.25 s");
  EXPECT_EQ(readable_time(0.25, 0.001), "0.250 s");
  EXPECT_EQ(readable_time(1.5e-5, 5e-6), "0.000015 s");
}

}  // namespace
}  // namespace drape
