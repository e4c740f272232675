#include "reports/result_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "core/files.hpp"
#include "core/text.hpp"
#include "reports/latex.hpp"

namespace drape {
namespace {

/// Returns true if a spreadsheet would treat a cell as a formula, leading apostrophes aside.
bool begins_formula(std::string_view cell) {
  const std::size_t first = cell.find_first_not_of('\'');
  return first != std::string_view::npos && std::string_view("=+-@\t\r").find(cell[first]) != std::string_view::npos;
}

bool is_number(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error != std::errc::invalid_argument && end == cell.data() + cell.size();
}

std::string quoted(const std::string& text) {
  std::string cell = begins_formula(text) && !is_number(text) ? "'" + text : text;
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string result = "\"";
  for (const char c : cell) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

}  // namespace

bool is_numeric(const ResultTable& table, std::size_t column) {
  return std::all_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
    const std::string& cell = row[column];
    return cell.empty() || cell == "–" || std::string_view("0123456789-+").find(cell[0]) != std::string_view::npos;
  });
}

std::size_t leading_columns(const ResultTable& table) {
  for (std::size_t count = 1; count < table.columns.size(); ++count) {
    std::set<std::vector<std::string>> seen;
    for (const auto& row : table.rows) seen.insert({row.begin(), row.begin() + static_cast<std::ptrdiff_t>(count)});
    if (seen.size() == table.rows.size()) return count;
  }
  return 1;
}

std::vector<std::vector<std::size_t>> parts_within(std::size_t width, const std::vector<std::size_t>& widths,
                                                   std::size_t leading, std::size_t gap) {
  std::vector<std::size_t> begin;
  std::size_t begin_width = 0;
  for (std::size_t c = 0; c < std::min(leading, widths.size()); ++c) {
    begin.push_back(c);
    begin_width += gap + widths[c];
  }
  if (leading > 1 && begin_width > width / 2) return parts_within(width, widths, 1, gap);
  std::vector<std::vector<std::size_t>> parts{begin};
  std::size_t used = begin_width;
  for (std::size_t c = begin.size(); c < widths.size(); ++c) {
    if (used + gap + widths[c] > width && parts.back().size() > begin.size()) {
      parts.push_back(begin);
      used = begin_width;
    }
    parts.back().push_back(c);
    used += gap + widths[c];
  }
  return parts;
}

std::string three_digits(double value) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, value < 10 ? 2 : value < 100 ? 1 : 0) : "–";
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t c = 0; c < cells.size(); ++c) line.append(c == 0 ? "" : ",").append(quoted(cells[c]));
  return line + "\n";
}

std::string csv_text(std::string cell) {
  if (cell.starts_with('\'') && begins_formula(cell)) cell.erase(0, 1);
  return cell;
}

std::string to_text(const ResultTable& table, std::size_t width) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    widths.push_back(columns_of(table.columns[c]));
    for (const auto& row : table.rows) widths[c] = std::max(widths[c], columns_of(row[c]));
  }
  const auto line = [&](const std::vector<std::string>& cells, const std::vector<std::size_t>& part) {
    std::string text;
    for (const std::size_t c : part) {
      const std::string space(widths[c] - columns_of(cells[c]), ' ');
      text.append("  ").append(is_numeric(table, c) ? space + cells[c] : cells[c] + space);
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string text = wrapped(table.title, width, 2) + "\n";
  const std::vector<std::vector<std::size_t>> parts = parts_within(width, widths, leading_columns(table));
  for (const std::vector<std::size_t>& part : parts) {
    text += (&part == &parts.front() ? "" : "\n") + line(table.columns, part);
    for (const auto& row : table.rows) text += line(row, part);
  }
  for (const std::string& note : table.notes) text += wrapped(fmt::format("  {}\n", note), width);
  return text;
}

std::string to_markdown(const ResultTable& table) {
  std::string text = fmt::format("### {}\n\n|", markdown(table.title)), rule = "|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    text += fmt::format(" {} |", markdown(table.columns[c]));
    rule += is_numeric(table, c) ? "---:|" : "---|";
  }
  text += fmt::format("\n{}\n", rule);
  for (const auto& row : table.rows) {
    text += "|";
    for (const std::string& cell : row) text += fmt::format(" {} |", markdown(cell));
    text += "\n";
  }
  for (const std::string& note : table.notes) text += fmt::format("\n{}\n", markdown(note));
  return text;
}

std::string to_csv(const ResultTable& table) {
  std::string text = csv_line(table.columns);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

void write_table(const ResultTable& table, const std::filesystem::path& folder) {
  write_file_atomically(folder / (table.name + ".csv"), to_csv(table));
  if (table.rows.size() <= most_set_rows) write_set_table(table, folder);
}

void write_set_table(const ResultTable& table, const std::filesystem::path& folder) {
  write_file_atomically(folder / (table.name + ".md"), to_markdown(table));
  write_file_atomically(folder / (table.name + ".tex"), to_latex(table));
}

html::Table page_table(const ResultTable& table) {
  html::Table shown{table.title, {}, {}};
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    shown.columns.push_back({table.columns[c], is_numeric(table, c)});
  for (const auto& row : table.rows) shown.rows.emplace_back(row.begin(), row.end());
  return shown;
}

html::Markup to_html(const ResultTable& table) {
  html::Markup markup = html::table(page_table(table));
  for (const std::string& note : table.notes) markup += html::note(note);
  return markup;
}

}  // namespace drape
