#include "sweep/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

#include "core/text.hpp"
#include "figures/result_table.hpp"
#include "html/latex.hpp"
#include "html/markdown.hpp"

namespace drape {
namespace {

constexpr const char* nothing = "–";

/// Returns the names of all figures, in order of first appearance.
std::vector<std::string> figure_names(const SweepResults& results) {
  std::vector<std::string> names;
  for (const SweepRow& row : results.rows) {
    for (const auto& [name, value] : row.record.figures) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// Returns true if Markdown can show a file as a picture.
bool is_picture(const std::string& file) {
  constexpr std::array<const char*, 4> endings{".gif", ".webp", ".png", ".apng"};
  return std::ranges::any_of(endings, [&](const char* ending) { return file.ends_with(ending); });
}

std::string link_path(const std::string& path) {
  std::string target;
  for (const std::filesystem::path& part : std::filesystem::path(path)) {
    target += (target.empty() ? "" : "/") + link_target(part.string());
  }
  return target;
}

/// Returns a grid cell for a run: its film, or the reason why there is none.
std::string film_cell(const SweepResults& results, const SweepRow* row) {
  if (row == nullptr) return nothing;
  const std::string film = film_of(results, *row);
  const std::string outcome =
      row->record.outcome == RunOutcome::completed ? "" : markdown(name_of(row->record.outcome));
  if (film.empty()) return outcome.empty() ? nothing : outcome;
  const std::string link = fmt::format("{}[{}]({})", is_picture(film) ? "!" : "",
                                       markdown(label_of(results.plan, results.planned(*row))), link_path(film));
  return outcome.empty() ? link : link + " " + outcome;
}

std::string markdown_grid(const SweepResults& results, const SweepGrid& grid) {
  std::string text = grid.title.empty() ? "" : fmt::format("## {}\n\n", markdown(grid.title));
  text += fmt::format("| {} |", grid.down == nullptr ? "" : markdown(grid.down->name));
  std::string rule = "|---|";
  for (std::size_t c = 0; c < grid.cells.front().size(); ++c) {
    const std::string head =
        grid.across == nullptr ? "" : fmt::format("{} = {}", grid.across->name, grid.across->values[c]);
    text += fmt::format(" {} |", markdown(head));
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  const auto line = [&](const std::string& head, const std::vector<const SweepRow*>& cells, const auto& content) {
    text += fmt::format("| {} |", head);
    for (const SweepRow* cell : cells) text += fmt::format(" {} |", content(cell));
    text += "\n";
  };
  const auto figure = [](const char* name) {
    return [name](const SweepRow* row) { return row == nullptr ? nothing : short_figure(*row, name); };
  };
  for (std::size_t r = 0; r < grid.cells.size(); ++r) {
    const std::string value = grid.down == nullptr ? "" : fmt::format("**{}**", markdown(grid.down->values[r]));
    line(value, grid.cells[r], [&](const SweepRow* row) { return film_cell(results, row); });
    line("µs per step", grid.cells[r], figure("step_us.median"));
    line("iterations per step", grid.cells[r], figure("iterations.mean"));
  }
  return text + "\n";
}

std::string latex_cells(const SweepRow* row) {
  if (row == nullptr) return " & -- & --";
  if (row->record.outcome != RunOutcome::completed)
    return fmt::format(" & \\multicolumn{{2}}{{c}}{{{}}}", html::latex(name_of(row->record.outcome)));
  const auto cell = [&](const char* name) {
    const std::string text = short_figure(*row, name);
    return text == nothing ? "--" : text;
  };
  return fmt::format(" & {} & {}", cell("step_us.median"), cell("iterations.mean"));
}

std::string latex_grid(const SweepGrid& grid) {
  const std::size_t columns = grid.cells.front().size();
  std::string form = "l", heads = grid.down == nullptr ? "" : html::latex(grid.down->name), units;
  for (std::size_t c = 0; c < columns; ++c) {
    form += "|rr";
    const std::string head = grid.across == nullptr ? "" : grid.across->name + " = " + grid.across->values[c];
    heads += fmt::format(" & \\multicolumn{{2}}{{c{}}}{{{}}}", c + 1 == columns ? "" : "|", html::latex(head));
    units += " & $\\mu$s & it.";
  }
  std::string text = fmt::format("\\begin{{table}}\n\\centering\n\\begin{{tabular}}{{{}}}\n", form);
  text += fmt::format("{} \\\\\n{} \\\\\n\\hline\n", heads, units);
  for (std::size_t r = 0; r < grid.cells.size(); ++r) {
    text += grid.down == nullptr ? "" : html::latex(grid.down->values[r]);
    for (const SweepRow* row : grid.cells[r]) text += latex_cells(row);
    text += " \\\\\n";
  }
  const std::string of = grid.title.empty() ? "" : ", " + html::latex(grid.title);
  return text +
         fmt::format("\\end{{tabular}}\n\\caption{{Microseconds and iterations of a step{}}}\n\\end{{table}}\n", of);
}

}  // namespace

std::string short_figure(const SweepRow& row, const std::string& name) {
  std::string text = row.record.figure(name);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return nothing;
  if (text.find_first_of(".e") == std::string::npos) return text;
  return value != 0 && (value < 0.01 || value >= 1e7) ? fmt::format("{:.2e}", value) : three_digits(value);
}

std::string film_of(const SweepResults& results, const SweepRow& row) {
  for (const std::string& file : row.record.files) {
    if (file.starts_with("film.")) return "runs/" + results.planned(row).key + "/" + file;
  }
  return {};
}

std::string runs_csv(const SweepResults& results) {
  ResultTable table{"runs", {}, {"run", "scene"}, {}, {}};
  for (const Variation& variation : results.plan.request.varied) table.columns.push_back(variation.key);
  const std::vector<std::string> names = figure_names(results);
  table.columns.insert(table.columns.end(), {"outcome", "reason"});
  table.columns.insert(table.columns.end(), names.begin(), names.end());
  table.columns.insert(table.columns.end(), {"seconds", "timed", "key"});
  for (const SweepRow& row : results.rows) {
    const PlannedRun& planned = results.planned(row);
    const RunRecord& record = row.record;
    std::vector<std::string> cells{std::to_string(row.run + 1), results.plan.names[planned.scene]};
    cells.insert(cells.end(), planned.values.begin(), planned.values.end());
    cells.insert(cells.end(), {name_of(record.outcome), record.reason});
    for (const std::string& name : names) cells.push_back(record.figure(name));
    cells.insert(cells.end(),
                 {record.seconds > 0 ? fmt::format("{:.6g}", record.seconds) : "", record.timed, planned.key});
    table.rows.push_back(std::move(cells));
  }
  return to_csv(table);
}

std::string sweep_markdown(const SweepResults& results) {
  std::string text = fmt::format("# {}\n\n", markdown(results.headline()));
  for (const SweepGrid& grid : grids_of(results)) text += markdown_grid(results, grid);
  for (const std::string& trouble : results.troubles()) text += fmt::format("- {}\n", markdown(trouble));
  return text + fmt::format("\n    {}\n", shown(command_of(results.plan.request)));
}

std::string sweep_latex(const SweepResults& results) {
  std::string text;
  for (const SweepGrid& grid : grids_of(results)) text += (text.empty() ? "" : "\n") + latex_grid(grid);
  return text;
}

}  // namespace drape
