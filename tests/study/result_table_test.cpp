#include "reports/result_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <regex>

#include "core/text.hpp"
#include "reports/latex.hpp"
#include "tests/support/hostile_names.hpp"
#include "tests/support/scratch_folder.hpp"

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
  // Method and step identify the rows, so both are in every part.
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
  EXPECT_EQ(
      to_latex(table),
      "% Title\n% A note.\n% needs \\usepackage{array,booktabs}; fits a column of 3.3 in\n"
      "{\\footnotesize\\setlength{\\tabcolsep}{3pt}%\n\\begin{tabular}{@{}lr@{}}\n  \\toprule\n  method & µs \\\\\n"
      "  \\midrule\n  a, \"b\" $|$ c & 9.5 \\\\\n  d & -- \\\\\n  \\bottomrule\n\\end{tabular}}\n");
}

std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  std::string text;
  while (const std::size_t count = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), count);
  return pclose(pipe) == 0 ? text : "";
}

/// Returns the cells of a table, row by row, as pandoc reads a file.
std::vector<std::vector<std::string>> read_by_pandoc(const std::string& file, const std::string& format) {
  std::string html = output_of("pandoc --wrap=none -f " + format + " -t html '" + file + "'");
  const std::array<std::array<const char*, 2>, 7> written{
      {{"∥", "‖"}, {"⋅", "·"}, {"<[^>]*>", ""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}}};
  std::vector<std::vector<std::string>> rows;
  static const std::regex row("<tr[^>]*>([^]*?)</tr>"), cell("<t[dh][^>]*>([^]*?)</t[dh]>");
  for (std::sregex_iterator r(html.begin(), html.end(), row), end; r != end; ++r) {
    rows.emplace_back();
    const std::string inside = (*r)[1];
    for (std::sregex_iterator c(inside.begin(), inside.end(), cell); c != end; ++c) {
      std::string text = (*c)[1];
      text = std::regex_replace(text, std::regex("<span class=\"math inline\">([^]*?)</span>"), "$1");
      text = std::regex_replace(text, std::regex("<sup>−7</sup>"), "⁻⁷");
      text = std::regex_replace(text, std::regex("<sup>2</sup>"), "²");
      for (const auto& [from, to] : written) text = std::regex_replace(text, std::regex(from), to);
      rows.back().push_back(text);
    }
  }
  return rows;
}

// pandoc converts both to Word files; a reader that does not know a macro drops the sign.
TEST(ResultTable, HasTheSameCellsForThoseWhoReadLatexAndMarkdown) {
  if (output_of("pandoc --version 2>/dev/null").empty()) GTEST_SKIP() << "pandoc is not installed";
  const ResultTable all{
      "all",
      "Title: 100 % of a_b",
      {"step [s]", "error ‖∇g‖ [m/s²]", "µs per step, ε = 10⁻⁷", "C:\\~^{}<&>#$"},
      {{"1 × 2 · 3", "−0.5", "≤ 1.5 ≈ 2 ≥ 1", "a | b"}, {"τ → λ", "∞", "90° … ½", "π Σ"}, {"_*x*_", "[1](2)", "", "1"}},
      {"A note."}};
  std::vector<std::vector<std::string>> expected{all.columns};
  expected.insert(expected.end(), all.rows.begin(), all.rows.end());
  const test::ScratchFolder folder;
  write_set_table(all, folder.path());
  EXPECT_EQ(read_by_pandoc((folder.path() / "all.md").string(), "gfm"), expected);
  EXPECT_EQ(read_by_pandoc((folder.path() / "all.tex").string(), "latex"), expected);
}

/// Undoes a program's typographic quotes and spaces.
std::string without_typography(std::string text) {
  const std::array<std::array<const char*, 2>, 12> written{{{"`", "'"},
                                                            {"‘", "'"},
                                                            {"’", "'"},
                                                            {"“", "\""},
                                                            {"”", "\""},
                                                            {"&#39;", "'"},
                                                            {"&quot;", "\""},
                                                            {"&lt;", "<"},
                                                            {"&gt;", ">"},
                                                            {"&amp;", "&"},
                                                            {" +", " "},
                                                            {"^ | $", ""}}};
  for (const auto& [from, to] : written) text = std::regex_replace(text, std::regex(from), to);
  return text;
}

TEST(ResultTable, HoldsHostileNamesInOneCellEach) {
  if (output_of("pandoc --version 2>/dev/null").empty()) GTEST_SKIP() << "pandoc is not installed";
  ResultTable names{"names", "Names", {"name", "number"}, {}, {}};
  for (const std::string& name : test::hostile_names) names.rows.push_back({name, "1"});
  const test::ScratchFolder folder;
  write_set_table(names, folder.path());
  for (const auto& [file, form] : {std::array{"names.md", "gfm"}, std::array{"names.tex", "latex"}}) {
    const auto rows = read_by_pandoc((folder.path() / file).string(), form);
    ASSERT_EQ(rows.size(), names.rows.size() + 1) << file;
    for (std::size_t r = 1; r < rows.size(); ++r) {
      ASSERT_EQ(rows[r].size(), 2U) << file << ": " << names.rows[r - 1][0];
      std::string expected = escape_controls(names.rows[r - 1][0]);
      std::ranges::replace(expected, '\n', ' ');
      EXPECT_EQ(without_typography(rows[r][0]), without_typography(expected)) << file;
      EXPECT_EQ(rows[r][1], "1") << file;
    }
  }
}

TEST(ResultTable, GivesSpreadsheetsNothingToCompute) {
  EXPECT_EQ(csv_line({"=1+1", "+cmd|' /C calc'!A0", "-x", "@SUM(A1)", "'=1", "it's"}),
            "'=1+1,'+cmd|' /C calc'!A0,'-x,'@SUM(A1),''=1,it's\n");
  EXPECT_EQ(csv_line({"\t=1", "\r=1", "=\"a\",b"}), "'\t=1,\"'\r=1\",\"'=\"\"a\"\",b\"\n");
  // Numbers stay numbers, as do values that a spreadsheet takes for text.
  EXPECT_EQ(csv_line({"-1.5", "+2e-3", "-inf", "1e999", "-1e-999", "–", "", "a=b"}),
            "-1.5,+2e-3,-inf,1e999,-1e-999,–,,a=b\n");
  for (const std::string& name : test::hostile_names) {
    const std::string line = csv_line({name});
    EXPECT_EQ(std::string_view("=+-@\t\r").find(line[line[0] == '"' ? 1 : 0]), std::string_view::npos) << name;
    for (const std::string& text : {name, "'" + name, "''" + name}) {
      std::string cell = csv_line({text});
      cell.pop_back();
      if (cell[0] == '"') cell = std::regex_replace(cell.substr(1, cell.size() - 2), std::regex("\"\""), "\"");
      EXPECT_EQ(csv_text(cell), text);
    }
  }
}

TEST(Markdown, KeepsCodeInItsFence) {
  EXPECT_EQ(markdown_code("drape accept out"), "`drape accept out`");
  EXPECT_EQ(markdown_code("a `b` ``c``"), "``` a `b` ``c`` ```");
  EXPECT_EQ(markdown_code("a\nb"), "`a\\x0ab`");
}

TEST(Markdown, ShowsTextAsItIs) {
  EXPECT_EQ(markdown("<b>&.toml"), "\\<b\\>\\&.toml");
  EXPECT_EQ(markdown("a|b\n`c` *d* [e](f)"), "a\\|b \\`c\\` \\*d\\* \\[e\\](f)");
}

TEST(Markdown, LinksToAnyFile) {
  EXPECT_EQ(link_to_file("a-1_b.svg"), "a-1_b.svg");
  EXPECT_EQ(link_to_file("x';system(\"a b\");#µ.svg"), "x%27%3Bsystem%28%22a%20b%22%29%3B%23%C2%B5.svg");
}

}  // namespace
}  // namespace drape
