#include "study/result_table.hpp"

#include <gtest/gtest.h>

namespace drape {
namespace {

const ResultTable table{"t", "Title", {"method", "µs"}, {{"a, \"b\" | c", "9.5"}, {"d", "–"}}, {"A note."}};

TEST(ResultTable, QuotesWhatCsvWouldSplit) { EXPECT_EQ(to_csv(table), "method,µs\n\"a, \"\"b\"\" | c\",9.5\nd,–\n"); }

TEST(ResultTable, SetsNumbersToTheRightWhateverBytesTheyTake) {
  EXPECT_EQ(to_text(table),
            "Title\n"
            "  method       µs\n"
            "  a, \"b\" | c  9.5\n"
            "  d              –\n"
            "  A note.\n");
}

TEST(ResultTable, EscapesWhatMarkdownWouldSplit) {
  EXPECT_EQ(to_markdown(table),
            "### Title\n\n| method | µs |\n|---|---:|\n| a, \"b\" \\| c | 9.5 |\n| d | – |\n\nA note.\n");
}

}  // namespace
}  // namespace drape
