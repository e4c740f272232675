#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "reports/components.hpp"

namespace drape {

/// A table of results, for the terminal, CSV, Markdown, LaTeX and pages.
struct ResultTable {
  std::string name;   ///< name of its file: "table1"
  std::string title;  ///< "Table 1: no sphere, k = 18 N/m"
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;  ///< sentences below the table
};

/// Formats a number with three digits, or all before the point: "2.35", "23.5", "2347"; "–" if it is not finite.
std::string three_digits(double value);

/// Returns cells as a line of RFC 4180, quoted if necessary. Text that a spreadsheet would treat as a formula (it
/// starts with = + - or @ and is not a number) gets an apostrophe in front.
std::string csv_line(const std::vector<std::string>& cells);
/// Returns the original text of a cell that csv_line() wrote.
std::string csv_text(std::string cell);

/// Formats a table for a terminal: aligned columns, numbers to the right. A table wider than `width` is split into
/// parts, each of which starts with the columns that identify its rows.
std::string to_text(const ResultTable& table, std::size_t width = unlimited_width);
std::string to_markdown(const ResultTable& table);
/// Formats a table as RFC 4180.
std::string to_csv(const ResultTable& table);
/// Formats a table for \input, in letters of 8 pt; needs booktabs and array. Cells are wrapped so that the table fits a
/// column of an article, or otherwise a page of two columns. A table too wide for that is split: each part repeats the
/// columns that identify the rows.
std::string to_latex(const ResultTable& table);
/// Returns true if every non-empty cell of a column starts like a number.
bool is_numeric(const ResultTable& table, std::size_t column);
/// Returns the number of first columns that identify the rows; every part of a split table repeats them.
std::size_t leading_columns(const ResultTable& table);
/// Splits the columns of a wide table into parts, each of which starts with the leading columns.
/// @param widths of the columns, in the unit of `width`
/// @param gap    between two columns
std::vector<std::vector<std::size_t>> parts_within(std::size_t width, const std::vector<std::size_t>& widths,
                                                   std::size_t leading, std::size_t gap = 2);
/// Most rows of a table in a document.
inline constexpr std::size_t most_set_rows = 200;

/// Writes NAME.csv; also NAME.md and NAME.tex if the table is short enough for a document.
/// @throws OutputError
void write_table(const ResultTable& table, const std::filesystem::path& folder);
/// Writes only NAME.md and NAME.tex.
/// @throws OutputError
void write_set_table(const ResultTable& table, const std::filesystem::path& folder);
/// Returns the table for a page, without its notes.
html::Table page_table(const ResultTable& table);
html::Markup to_html(const ResultTable& table);

}  // namespace drape
