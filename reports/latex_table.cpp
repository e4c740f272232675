#include "reports/result_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>

#include "reports/latex.hpp"

namespace drape {
namespace {

/// Width of a column of an article, and of a page of two of them [pt, of 72.27 to the inch].
constexpr double latex_column = 3.3 * 72.27, latex_page = 7 * 72.27;
constexpr double gap = 6;  // between two columns: twice \tabcolsep [pt]

/// Returns an upper estimate of a character's width in Computer Modern of 8 pt [pt].
double width_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if ((byte & 0xC0U) == 0x80U) return 0;  // within a UTF-8 character
  if (byte >= 0x80U) return 9.0;          // a symbol
  if (c == ' ') return 3.0;
  if (std::string_view("mwMW%&@#").find(c) != std::string_view::npos) return 8.8;
  if (std::isupper(byte) != 0 || std::string_view("<>=+|~").find(c) != std::string_view::npos) return 6.7;
  if (std::string_view("ijlft.,:;'()[]").find(c) != std::string_view::npos) return 3.4;
  return 4.8;
}

double width_of(std::string_view text) {
  return std::accumulate(text.begin(), text.end(), 0.0, [](double sum, char c) { return sum + width_of(c); });
}

/// Returns the width of the longest part of a text that LaTeX does not break: a word, or its part up to a hyphen.
double longest_part(std::string_view text) {
  double longest = 0, part = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != ' ') part += width_of(text[i]);
    longest = std::max(longest, part);
    const bool hyphen = text[i] == '-' && i > 0 && std::isalpha(static_cast<unsigned char>(text[i - 1])) != 0;
    if (text[i] == ' ' || hyphen) part = 0;
  }
  return longest;
}

/// Widths of a column [pt].
struct Extent {
  double least = 0;    ///< with every cell broken wherever possible
  double natural = 0;  ///< without breaks
};

Extent extent_of(const ResultTable& table, std::size_t column) {
  Extent extent;
  const auto add = [&](const std::string& cell) {
    extent.least = std::max(extent.least, longest_part(cell));
    extent.natural = std::max(extent.natural, width_of(cell));
  };
  add(table.columns[column]);
  for (const auto& row : table.rows) add(row[column]);
  return extent;
}

double sum(const std::vector<Extent>& extents, double Extent::*width) {
  const double gaps = gap * static_cast<double>(extents.size() - 1);
  return std::accumulate(extents.begin(), extents.end(), gaps, [&](double s, const Extent& e) { return s + e.*width; });
}

/// Returns the widths of columns that fit into a room: the least ones, with the rest shared by need. Nothing if they do
/// not fit.
std::optional<std::vector<double>> fitted(const std::vector<Extent>& extents, double room) {
  const double least = sum(extents, &Extent::least), natural = sum(extents, &Extent::natural);
  if (least > room) return std::nullopt;
  const double share = natural <= room ? 1 : (room - least) / (natural - least);
  std::vector<double> widths;
  for (const Extent& e : extents) widths.push_back(e.least + share * (e.natural - e.least));
  return widths;
}

std::string latex_line(const std::vector<std::string>& cells, const std::vector<std::size_t>& part) {
  std::vector<std::string> texts;
  for (const std::size_t c : part) texts.push_back(html::latex(cells[c]));
  return fmt::format("  {} \\\\\n", fmt::join(texts, " & "));
}

/// Returns some columns of a table as a tabular environment. Columns of their natural width stay unwrapped.
std::string tabular(const ResultTable& table, const std::vector<std::size_t>& part, const std::vector<Extent>& extents,
                    const std::vector<double>& widths) {
  std::string form, rows;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const bool numeric = is_numeric(table, part[i]);
    if (widths[i] >= extents[i].natural) {
      form += numeric ? "r" : "l";
    } else {
      form += fmt::format(">{{\\{}\\arraybackslash{{}}}}p{{{:.1f}pt}}", numeric ? "raggedleft" : "raggedright",
                          std::floor(10 * widths[i]) / 10);
    }
  }
  for (const auto& row : table.rows) rows += latex_line(row, part);
  return fmt::format(
      "\\begin{{tabular}}{{@{{}}{}@{{}}}}\n  \\toprule\n{}  \\midrule\n{}  \\bottomrule\n\\end{{tabular}}", form,
      latex_line(table.columns, part), rows);
}

/// Returns the parts of a table for a room, each with all columns that fit.
std::vector<std::vector<std::size_t>> parts_of(const ResultTable& table, const std::vector<Extent>& extents,
                                               double room) {
  std::vector<std::size_t> widths;
  for (const Extent& e : extents) widths.push_back(static_cast<std::size_t>(std::ceil(e.least)));
  return parts_within(static_cast<std::size_t>(room), widths, leading_columns(table), static_cast<std::size_t>(gap));
}

}  // namespace

std::string to_latex(const ResultTable& table) {
  std::vector<Extent> all;
  for (std::size_t c = 0; c < table.columns.size(); ++c) all.push_back(extent_of(table, c));
  const bool narrow = sum(all, &Extent::least) <= latex_column;
  const double room = narrow ? latex_column : latex_page;
  std::vector<std::string> tabulars;
  for (const std::vector<std::size_t>& part : parts_of(table, all, room)) {
    std::vector<Extent> extents;
    std::vector<double> natural;
    for (const std::size_t c : part) {
      extents.push_back(all[c]);
      natural.push_back(all[c].natural);
    }
    tabulars.push_back(tabular(table, part, extents, fitted(extents, room).value_or(natural)));
  }
  std::string notes;
  for (const std::string& note : table.notes) notes += fmt::format("% {}\n", html::latex(note));
  return fmt::format(
      "% {}\n{}% needs \\usepackage{{array,booktabs}}; "
      "{}\n{{\\footnotesize\\setlength{{\\tabcolsep}}{{{:g}pt}}%\n{}}}\n",
      html::latex(table.title), notes,
      narrow ? "fits a column of 3.3 in" : "fits a page of 7 in, in a document of two columns with table*", gap / 2,
      fmt::join(tabulars, "\\par\\medskip\n"));
}

}  // namespace drape
