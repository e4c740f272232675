#include "core/text.hpp"

#include <gtest/gtest.h>

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
  EXPECT_EQ(printable("\xEF\xBF\xBF"), mark + mark + mark);  // U+FFFF, no character
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

}  // namespace
}  // namespace drape
