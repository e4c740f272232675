#include "study/result_table.hpp"

#include <gtest/gtest.h>

#include "html/markdown.hpp"

namespace drape {
namespace {

const ResultTable table{"t", "Title", {"method", "µs"}, {{"a, \"b\" | c", "9.5"}, {"d", "–"}}, {"A note."}};

TEST(ResultTable, QuotesWhatCsvWouldSplit) { EXPECT_EQ(to_csv(table), "method,µs\n\"a, \"\"b\"\" | c\",9.5\nd,–\n"); }

TEST(ResultTable, SetsNumbersToTheRightWhateverBytesTheyTake) {
  EXPECT_EQ(to_text(table),
            "Title\n"
            "  method       µs\n"
            "  a, \"b\" | c  9.5\n"
            "  d             –\n"
            "  A note.\n");
}

TEST(ResultTable, ComesInPartsThatFitTheWindow) {
  const ResultTable wide{"w",
                         "Wide",
                         {"method", "h", "iterations", "time", "factor"},
                         {{"liu13", "0.1", "2", "1.5", "9"}, {"liu13", "0.2", "3", "2.5", "8"}},
                         {}};
  // Method and step tell the rows apart, so both are in every part.
  EXPECT_EQ(to_text(wide, 31),
            "Wide\n"
            "  method    h  iterations  time\n"
            "  liu13   0.1           2   1.5\n"
            "  liu13   0.2           3   2.5\n"
            "\n"
            "  method    h  factor\n"
            "  liu13   0.1       9\n"
            "  liu13   0.2       8\n");
}

TEST(ResultTable, EscapesWhatMarkdownWouldSplit) {
  EXPECT_EQ(to_markdown(table),
            "### Title\n\n| method | µs |\n|---|---:|\n| a, \"b\" \\| c | 9.5 |\n| d | – |\n\nA note.\n");
}

TEST(ResultTable, IsWrittenForLatex) {
  EXPECT_EQ(to_latex(table),
            "% Title\n% needs \\usepackage{booktabs}\n\\begin{tabular}{lr}\n  \\toprule\n  method & \\textmu{}s \\\\\n"
            "  \\midrule\n  a, \"b\" \\textbar{} c & 9.5 \\\\\n  d & -- \\\\\n  \\bottomrule\n\\end{tabular}\n");
}

TEST(Markdown, ShowsTextAsItIs) {
  EXPECT_EQ(markdown("<b>&.toml"), "\\<b\\>\\&.toml");
  EXPECT_EQ(markdown("a|b\n`c` *d* [e](f)"), "a\\|b \\`c\\` \\*d\\* \\[e\\](f)");
}

TEST(Markdown, LinksToAnyFile) {
  EXPECT_EQ(link_target("a-1_b.svg"), "a-1_b.svg");
  EXPECT_EQ(link_target("x';system(\"a b\");#µ.svg"), "x%27%3Bsystem%28%22a%20b%22%29%3B%23%C2%B5.svg");
}

}  // namespace
}  // namespace drape
