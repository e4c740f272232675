#include "study/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "study/markdown.hpp"

namespace drape {
namespace {

/// How many columns of a terminal the text takes: its code points.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

/// Whether everything in the column starts like a number, or there is nothing.
bool is_numeric(const ResultTable& table, std::size_t column) {
  return std::all_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
    const std::string& cell = row[column];
    return cell.empty() || cell == "–" || std::string_view("0123456789-+").find(cell[0]) != std::string_view::npos;
  });
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t c = 0; c < cells.size(); ++c) line.append(c == 0 ? "" : ",").append(quoted(cells[c]));
  return line + "\n";
}

}  // namespace

std::string three_digits(double value) { return fmt::format("{:.{}f}", value, value < 10 ? 2 : value < 100 ? 1 : 0); }

std::string to_text(const ResultTable& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    widths.push_back(width(table.columns[c]));
    for (const auto& row : table.rows) widths[c] = std::max(widths[c], width(row[c]));
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::string space(widths[c] - width(cells[c]), ' ');
      text.append("  ").append(is_numeric(table, c) ? space + cells[c] : cells[c] + space);
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string text = table.title + "\n" + line(table.columns);
  for (const auto& row : table.rows) text += line(row);
  for (const std::string& note : table.notes) text += fmt::format("  {}\n", note);
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

html::Markup to_html(const ResultTable& table) {
  html::Table shown{table.title, {}, {}};
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    shown.columns.push_back({table.columns[c], is_numeric(table, c)});
  for (const auto& row : table.rows) shown.rows.emplace_back(row.begin(), row.end());
  html::Markup markup = html::table(shown);
  for (const std::string& note : table.notes) markup += html::note(note);
  return markup;
}

}  // namespace drape
