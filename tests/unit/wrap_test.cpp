#include "core/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace drape {
namespace {

std::size_t longest_line(const std::string& text) {
  std::size_t longest = 0;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    longest = std::max(longest, columns_of(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return longest;
}

std::string without_breaks(std::string text) {
  std::string words;
  for (const char c : text) {
    const bool space = c == ' ' || c == '\n';
    if (!space || (!words.empty() && words.back() != ' ')) words += space ? ' ' : c;
  }
  return words;
}

TEST(Wrap, BreaksAtSpacesAndKeepsEveryWord) {
  const std::string text = "  The cloth hangs from two corners under gravity and swings for eight seconds, µ = 0.3.";
  for (const std::size_t width : {24U, 40U, 60U, 85U}) {
    const std::string result = wrapped(text, width, 2);
    EXPECT_LE(longest_line(result), width) << result;
    EXPECT_EQ(without_breaks(result), without_breaks(text));
  }
  EXPECT_EQ(wrapped("  one two three four five six", 24, 2), "  one two three four\n    five six");
}

TEST(Wrap, LeavesAloneWhatFitsAndWhatCannot) {
  const std::string text = "a line\n\n  and   another\n";
  EXPECT_EQ(wrapped(text, 20), text);
  EXPECT_EQ(wrapped(std::string(200, 'a').append(" b"), unlimited_width), std::string(200, 'a').append(" b"));
  EXPECT_EQ(wrapped(std::string(50, 'a').append(" b"), 30), std::string(50, 'a').append("\nb"));
  // Characters count, not bytes.
  EXPECT_EQ(wrapped("µµµµµµµµµµ µµµµµµµµµµ µµµµµµµµ", 30), "µµµµµµµµµµ µµµµµµµµµµ µµµµµµµµ");
}

TEST(Wrap, ContinuesADescriptionInItsColumn) {
  const std::string line = "  --frames TEXT               Only these frames of the film, and no others: A..B";
  EXPECT_EQ(wrapped_help(line, 60), "  --frames TEXT               Only these frames of the film,\n" +
                                        std::string(30, ' ') + "and no others: A..B");
}

}  // namespace
}  // namespace drape
