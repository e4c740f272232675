#include "sweep/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/sealed_json.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "reports/latex.hpp"
#include "reports/result_table.hpp"
#include "sweep/run_sweep.hpp"

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
    target += (target.empty() ? "" : "/") + link_to_file(part.string());
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

std::string latex_grid(const SweepGrid& grid) {
  const std::string title = "Microseconds and iterations of a step" + (grid.title.empty() ? "" : ", " + grid.title);
  ResultTable table{
      .name = {}, .title = title, .columns = {grid.down == nullptr ? "" : grid.down->name}, .rows = {}, .notes = {}};
  for (std::size_t c = 0; c < grid.cells.front().size(); ++c) {
    const std::string with =
        grid.across == nullptr ? "" : fmt::format(", {} = {}", grid.across->name, grid.across->values[c]);
    table.columns.insert(table.columns.end(), {"µs" + with, "iterations" + with});
  }
  for (std::size_t r = 0; r < grid.cells.size(); ++r) {
    std::vector<std::string> cells{grid.down == nullptr ? "" : grid.down->values[r]};
    for (const SweepRow* row : grid.cells[r]) {
      const bool completed = row != nullptr && row->record.outcome == RunOutcome::completed;
      const auto figure = [&](const char* name) { return row == nullptr ? nothing : short_figure(*row, name); };
      cells.push_back(row == nullptr || completed ? figure("step_us.median") : name_of(row->record.outcome));
      cells.push_back(completed ? figure("iterations.mean") : nothing);
    }
    table.rows.push_back(std::move(cells));
  }
  return fmt::format("\\begin{{table}}\n\\centering\n{}\\caption{{{}}}\n\\end{{table}}\n", to_latex(table),
                     html::latex(title));
}

}  // namespace

std::string short_figure(const SweepRow& row, const std::string& name) {
  std::string text = row.record.figure(name);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return nothing;
  if (text.find_first_of(".e") == std::string::npos) return text;
  return value != 0 && (value < 0.1 || value >= 1e7) ? fmt::format("{:.2e}", value) : three_digits(value);
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
  return text + fmt::format("\n    {}\n", shown(results.command()));
}

std::string sweep_latex(const SweepResults& results) {
  std::string text;
  for (const SweepGrid& grid : grids_of(results)) text += (text.empty() ? "" : "\n") + latex_grid(grid);
  return text;
}

using Json = nlohmann::ordered_json;
namespace {

constexpr int format_number = 3;
constexpr int indent = 1;  // spaces per level in sweep.json
constexpr std::size_t most_sweep_bytes = std::size_t{1} << 30;

/// Checks the keys of runs, which name their folders. Refused runs have none.
void require_names(const SweepPlan& plan, const std::filesystem::path& file) {
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const PlannedRun& run = plan.runs[i];
    if (run.key.empty() && !run.refusal.empty()) continue;
    name_in_folder(run.key, file, fmt::format("plan.runs[{}].key", i));
  }
}

/// Returns the index of a value on an axis; appends a new value.
std::size_t place_on(SweepAxis& axis, const std::string& value) {
  const auto found = std::ranges::find(axis.values, value);
  if (found != axis.values.end()) return static_cast<std::size_t>(found - axis.values.begin());
  axis.values.push_back(value);
  return axis.values.size() - 1;
}

/// Returns the value of a run on each axis.
std::vector<std::string> values_on_axes(const SweepPlan& plan, const PlannedRun& run) {
  std::vector<std::string> values{plan.names[run.scene]};
  if (plan.request.zipped) {
    values.push_back(fmt::format("{}", fmt::join(run.values, ", ")));
  } else {
    values.insert(values.end(), run.values.begin(), run.values.end());
  }
  return values;
}

std::vector<SweepAxis> all_axes(const SweepPlan& plan) {
  std::vector<SweepAxis> axes{{"scene", {}}};
  std::vector<std::string> keys;
  for (const Variation& variation : plan.request.varied) keys.push_back(variation.key);
  if (plan.request.zipped) keys = {fmt::format("{}", fmt::join(keys, ", "))};
  for (const std::string& key : keys) axes.push_back({key, {}});
  return axes;
}

/// Removes axes with a single value.
void drop_single_values(SweepResults& results) {
  for (std::size_t a = results.axes.size(); a-- > 0;) {
    if (results.axes[a].values.size() > 1) continue;
    results.axes.erase(results.axes.begin() + static_cast<std::ptrdiff_t>(a));
    for (SweepRow& row : results.rows) row.places.erase(row.places.begin() + static_cast<std::ptrdiff_t>(a));
  }
}

RunRecord record_of(const PlannedRun& run, const std::filesystem::path& folder) {
  if (!run.refusal.empty()) {
    RunRecord refused;
    refused.outcome = RunOutcome::refused;
    refused.reason = run.refusal;
    return refused;
  }
  if (auto record = read_run(folder, run.key)) return *record;
  return {};
}

}  // namespace

void write_sweep_file(const std::filesystem::path& folder, const SweepFile& file) {
  const Json json{{"format", format_number}, {"shard", file.shard.text()}, {"plan", plan_json(file.plan)}};
  write_file_atomically(folder / sweep_mark, sealed_json(json, indent));
}

std::optional<SweepFile> read_sweep_file(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / sweep_mark;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    const Json json = Json::parse(read_file(file, most_sweep_bytes));
    if (const int found = json.at("format"); found != format_number) {
      throw UsageError(fmt::format("{}: it is of format {}, and this drape reads format {}: use the one that wrote it",
                                   shown(file), found, format_number));
    }
    if (json.at("checksum").get<std::string>() != json_checksum(json, indent))
      throw std::invalid_argument("its checksum is wrong");
    SweepFile sweep{plan_of(json.at("plan")), parse_shard(json.at("shard"))};
    require_names(sweep.plan, file);
    return sweep;
  } catch (const Error&) {
    throw;
  } catch (const Json::parse_error& error) {
    throw UsageError(fmt::format("{}: it is damaged at byte {}; drape sweep writes it anew", shown(file), error.byte));
  } catch (const Json::exception&) {
    throw UsageError(fmt::format("{}: it is damaged: a value is missing or of another kind; drape sweep writes it anew",
                                 shown(file)));
  } catch (const std::exception& error) {
    throw UsageError(fmt::format("{}: it is damaged ({}); drape sweep writes it anew", shown(file), error.what()));
  }
}

std::size_t SweepResults::count(RunOutcome outcome) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [&](const SweepRow& row) { return row.record.outcome == outcome; }));
}

std::string SweepResults::command() const { return typed_command.empty() ? command_of(plan.request) : typed_command; }

std::string SweepResults::headline() const {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < run_outcome_names.size(); ++i) {
    const std::size_t found = count(static_cast<RunOutcome>(i));
    if (found > 0) parts.push_back(fmt::format("{} {}", found, run_outcome_names[i]));
  }
  return fmt::format("{} {}: {}", rows.size(), rows.size() == 1 ? "run" : "runs",
                     parts.empty() ? "nothing to do" : fmt::format("{}", fmt::join(parts, ", ")));
}

std::vector<std::string> SweepResults::troubles() const {
  constexpr std::size_t most_told = 20;
  std::vector<std::pair<const SweepRow*, std::size_t>> found;  // the first run of a reason, and the number of its runs
  for (const SweepRow& row : rows) {
    if (row.record.reason.empty()) continue;
    const auto same = std::ranges::find_if(found, [&](const auto& other) {
      return other.first->record.reason == row.record.reason && other.first->record.outcome == row.record.outcome;
    });
    if (same == found.end()) {
      found.emplace_back(&row, 1);
    } else {
      ++same->second;
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [row, count] : found) {
    if (sentences.size() == most_told) break;
    const std::string label = label_of(plan, planned(*row));
    sentences.push_back(fmt::format("{}: {}: {}",
                                    count == 1 ? label : fmt::format("{} runs, the first of them {}", count, label),
                                    name_of(row->record.outcome), row->record.reason));
  }
  if (found.size() > most_told) sentences.push_back(fmt::format("and {} more, see runs.csv", found.size() - most_told));
  return sentences;
}

SweepResults read_results(const std::filesystem::path& folder, SweepFile file,
                          const std::map<std::size_t, RunRecord>& unwritten) {
  SweepResults results{.plan = std::move(file.plan), .shard = file.shard, .axes = {}, .rows = {}};
  results.axes = all_axes(results.plan);
  for (const std::size_t i : runs_of_shard(results.plan, results.shard)) {
    const PlannedRun& run = results.plan.runs[i];
    const auto lost = unwritten.find(i);
    SweepRow row{i, {}, lost == unwritten.end() ? record_of(run, folder) : lost->second};
    const std::vector<std::string> values = values_on_axes(results.plan, run);
    for (std::size_t a = 0; a < values.size(); ++a) row.places.push_back(place_on(results.axes[a], values[a]));
    results.rows.push_back(std::move(row));
  }
  drop_single_values(results);
  return results;
}

std::vector<SweepGrid> grids_of(const SweepResults& results) {
  const std::vector<SweepAxis>& axes = results.axes;
  const SweepAxis* across = axes.empty() ? nullptr : &axes.back();
  const SweepAxis* down = axes.size() < 2 ? nullptr : &axes[axes.size() - 2];
  const std::size_t others = axes.size() < 2 ? 0 : axes.size() - 2;
  std::map<std::vector<std::size_t>, SweepGrid> found;
  for (const SweepRow& row : results.rows) {
    const std::vector<std::size_t> rest(row.places.begin(), row.places.begin() + static_cast<std::ptrdiff_t>(others));
    SweepGrid& grid = found[rest];
    if (grid.cells.empty()) {
      grid.down = down;
      grid.across = across;
      grid.cells.assign(down == nullptr ? 1 : down->values.size(),
                        std::vector<const SweepRow*>(across == nullptr ? 1 : across->values.size()));
      std::vector<std::string> common;
      for (std::size_t a = 0; a < others; ++a) {
        common.push_back(fmt::format("{} = {}", axes[a].name, axes[a].values[rest[a]]));
      }
      grid.title = fmt::format("{}", fmt::join(common, ", "));
    }
    grid.cells[down == nullptr ? 0 : row.places[others]][across == nullptr ? 0 : row.places.back()] = &row;
  }
  std::vector<SweepGrid> grids;
  for (auto& [rest, grid] : found) grids.push_back(std::move(grid));
  return grids;
}

namespace fs = std::filesystem;
namespace {

/// @throws UsageError that names the difference of two plans
void require_same(const SweepPlan& plan, const fs::path& from, const SweepPlan& first, const fs::path& first_from) {
  if (plan.program != first.program) {
    throw UsageError(fmt::format("{} was made by {}, and {} by {}: one sweep is made by one program", shown(from),
                                 shown(plan.program), shown(first_from), shown(first.program)));
  }
  const Json a = plan_json(plan), b = plan_json(first);
  for (const auto& [key, value] : a.items()) {
    if (value != b.at(key)) {
      throw UsageError(
          fmt::format("{} and {} are not of one sweep: they differ in '{}'", shown(from), shown(first_from), key));
    }
  }
}

/// Makes a hard link to a file, or a copy if that is impossible.
void copy_or_link(const fs::directory_entry& from, const fs::path& to, std::error_code& error) {
  const bool is_link = from.is_symlink(error);  // copy links, whose target may be outside
  if (!is_link) fs::create_hard_link(from.path(), to, error);
  if (is_link || error) fs::copy_file(from.path(), to, error);
}

/// Copies or links a complete run's folder into another sweep, under a hidden name until it is complete.
void take_over(const fs::path& from, const fs::path& to) {
  const fs::path hidden = to.parent_path() / ("." + to.filename().string());
  std::error_code error;
  fs::remove_all(hidden, error);
  fs::create_directories(hidden, error);
  for (const auto& entry : fs::directory_iterator(from, error)) {
    if (!entry.is_regular_file(error)) continue;  // a run writes only files
    copy_or_link(entry, hidden / entry.path().filename(), error);
    if (error) break;
  }
  if (!error) fs::remove_all(to, error);
  if (!error) fs::rename(hidden, to, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove_all(hidden, ignored);
  throw OutputError(fmt::format("cannot write {}: {}", shown(to), error.message()));
}

/// The state of a run in a folder, from worst to best.
enum class Found { damaged, unsettled, settled };

/// States by the keys of runs.
using FoundRuns = std::map<std::string, Found>;

/// A part of a sweep, read completely before anything is written.
struct SweepPart {
  fs::path folder;
  SweepFile file;
  FoundRuns runs;
};

/// Adds the state of a run in a sweep's folder, if it has one.
void note_run(const fs::path& sweep, const std::string& key, FoundRuns& runs) {
  const std::optional<RunRecord> record = read_run(sweep, key);
  if (!record) return;
  if (record->damaged) {
    runs.emplace(key, Found::damaged);
  } else if (record->outcome != RunOutcome::not_run) {
    runs.emplace(key, record->settled() ? Found::settled : Found::unsettled);
  }
}

SweepPart read_part(const fs::path& folder) {
  require_links_inside(folder);
  std::optional<SweepFile> file = read_sweep_file(folder);
  if (!file) throw UsageError(fmt::format("{}: there is no sweep in it", shown(folder)));
  SweepPart part{.folder = folder, .file = std::move(*file), .runs = {}};
  for (const PlannedRun& run : part.file.plan.runs) note_run(folder, run.key, part.runs);
  return part;
}

/// Returns the runs that are already in the folder of the whole.
/// @throws UsageError if links lead out of the folder
FoundRuns runs_already_in(const fs::path& folder, const SweepPlan& plan) {
  FoundRuns runs;
  for (const PlannedRun& run : plan.runs) {
    if (run.key.empty()) continue;
    require_inside(run_place(folder, run.key), folder);
    note_run(folder, run.key, runs);
  }
  return runs;
}

}  // namespace

SweepFile merge_sweeps(const std::vector<fs::path>& folders, const fs::path& folder, const std::stop_token& stop) {
  std::vector<SweepPart> parts;
  for (const fs::path& part : folders) {
    parts.push_back(read_part(part));
    const SweepPart& first = parts.front();
    require_same(parts.back().file.plan, part, first.file.plan, first.folder);
  }
  if (parts.empty()) throw UsageError("there is nothing to merge");
  SweepFile whole = parts.front().file;
  whole.shard = {};
  require_inside(folder / "runs", folder);
  FoundRuns merged = runs_already_in(folder, whole.plan);
  const SweepLock lock(folder);
  remove_unfinished(folder);
  write_sweep_file(folder, whole);
  for (const PlannedRun& run : whole.plan.runs) {
    if (stop.stop_requested()) break;
    for (const SweepPart& part : parts) {
      const auto has = merged.find(run.key);
      const auto found = part.runs.find(run.key);
      std::error_code ignored;
      if (found == part.runs.end() || fs::equivalent(part.folder, folder, ignored)) continue;
      if (has != merged.end() && found->second <= has->second) continue;
      take_over(run_place(part.folder, run.key), run_place(folder, run.key));
      merged.insert_or_assign(run.key, found->second);
    }
  }
  return whole;
}

}  // namespace drape
