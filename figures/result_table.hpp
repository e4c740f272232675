#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/wrap.hpp"
#include "html/components.hpp"

namespace drape {

/// A table of results, which is printed, written as CSV, Markdown and LaTeX, and shown on a page.
struct ResultTable {
  std::string name;   ///< of its file: "table1"
  std::string title;  ///< "Table 1: no sphere, k = 18 N/m"
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;  ///< sentences below it
};

/// A cell with three digits, or all before the point: "2.35", "23.5", "2347"; "–" for what is no number.
std::string three_digits(double value);

/// Cells as a line of RFC 4180, quoted where they have to be. A text that a spreadsheet would compute, as it begins
/// with = + - or @ and is no number, is written with an apostrophe before it.
std::string csv_line(const std::vector<std::string>& cells);
/// The cell that csv_line() wrote so.
std::string csv_text(std::string cell);

/// For a terminal: columns in line, those that are numbers to the right. A table wider than `width` comes in parts,
/// each of which begins with the columns that tell its rows apart.
std::string to_text(const ResultTable& table, std::size_t width = unlimited_width);
std::string to_markdown(const ResultTable& table);
/// RFC 4180.
std::string to_csv(const ResultTable& table);
/// A tabular environment, as \input takes it; needs booktabs and nothing else.
std::string to_latex(const ResultTable& table);
/// The rows of the longest table that somebody would set into a text.
inline constexpr std::size_t most_set_rows = 200;

/// Writes NAME.csv, and NAME.md and NAME.tex of a table that is not too long for a text.
/// @throws OutputError
void write_table(const ResultTable& table, const std::filesystem::path& folder);
/// Writes NAME.md and NAME.tex alone.
/// @throws OutputError
void write_set_table(const ResultTable& table, const std::filesystem::path& folder);
/// @param cards whether its rows are cards in a narrow window
html::Markup to_html(const ResultTable& table, bool cards = false);

}  // namespace drape
