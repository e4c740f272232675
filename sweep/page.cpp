#include "sweep/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "codecs/codecs.hpp"
#include "codecs/png.hpp"
#include "core/read_file.hpp"
#include "html/explore.hpp"
#include "html/page.hpp"
#include "render/image_header.hpp"
#include "sweep/charts.hpp"
#include "sweep/tables.hpp"

namespace drape {
namespace {

using html::Markup;

constexpr std::size_t most_sheet_bytes = std::size_t{1} << 28;
constexpr double most_sheet_pixels = 1 << 28;        // larger ones are not drape's
constexpr std::size_t most_film_bytes = 48'000'000;  // total on a page
constexpr int widest = 240;                          // width of a film's picture on the page [pixels]
constexpr int gap = 6;                               // gap between the pictures of a contact sheet [pixels]

/// Returns a run's contact sheet for the page, scaled down and without gaps; nothing if it has none.
std::optional<html::Strip> strip_of(const SweepResults& results, const SweepRow& row,
                                    const std::filesystem::path& folder) {
  const std::vector<std::string>& files = row.record.files;
  const auto file = std::ranges::find_if(files, [](const std::string& name) { return name.starts_with("sheet."); });
  const int count = static_cast<int>(row.record.moments.size());
  if (file == files.end() || count == 0) return std::nullopt;
  const std::string& key = results.planned(row).key;
  const std::string bytes = read_file(run_place(folder, key) / *file, most_sheet_bytes);
  const auto size = size_in_header({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  if (!size || static_cast<double>(size->width) * size->height > most_sheet_pixels) return std::nullopt;
  const cv::Mat sheet = decode_picture(bytes, cv::IMREAD_COLOR);
  const int columns = std::min(count, sweep_sheet.columns), rows = (count + columns - 1) / columns;
  const int width = (sheet.cols - (columns - 1) * gap) / columns, height = (sheet.rows - (rows - 1) * gap) / rows;
  if (width < 1 || height < 1) return std::nullopt;
  const double factor = std::min(1.0, static_cast<double>(widest) / width);
  const cv::Size small(std::max(1, static_cast<int>(width * factor)), std::max(1, static_cast<int>(height * factor)));
  cv::Mat strip(rows * small.height, columns * small.width, CV_8UC3, cv::Scalar::all(255)), first;
  int poster = 0;
  double most = 0;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns, line = i / columns;
    const cv::Mat from = sheet(cv::Rect(column * (width + gap), line * (height + gap), width, height));
    cv::Mat to = strip(cv::Rect(column * small.width, line * small.height, small.width, small.height));
    cv::resize(from, to, small, 0, 0, cv::INTER_AREA);
    if (first.empty()) first = to.clone();
    // Use the picture that differs most from the first as the poster, since most films begin with a flat cloth.
    const double differs = cv::norm(to, first, cv::NORM_L1);
    if (differs <= most) continue;
    most = differs;
    poster = i;
  }
  const std::vector<std::uint8_t> png = png_from_bgr(strip);
  return html::Strip{.bytes = {png.begin(), png.end()},
                     .columns = columns,
                     .count = count,
                     .size = {small.width, small.height},
                     .poster = poster,
                     .alt = "Film of " + label_of(results.plan, results.planned(row))};
}

html::Markup outcome_badge(RunOutcome outcome) {
  using enum RunOutcome;
  const html::Tone tone = outcome == completed ? html::Tone::good
                          : outcome == not_run ? html::Tone::caution
                                               : html::Tone::bad;
  return html::badge(name_of(outcome), tone);
}

/// The film grids of a page.
class Films {
 public:
  Films(const SweepResults& results, const std::filesystem::path& folder) : results_(results), folder_(folder) {}

  Markup section() {
    Markup grids;
    for (const SweepGrid& grid : grids_of(results_)) grids += of(grid);
    if (moments_.empty()) return {};
    std::vector<std::string> names;
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      names.push_back(same_moments_ ? fmt::format("t = {:.2f} s", moments_[i])
                                    : fmt::format("moment {} of {}", i + 1, moments_.size()));
    }
    Markup content = html::strips("films-in-step", names, grids);
    if (left_out_ > 0) {
      content +=
          html::note(fmt::format("{} films are not shown here, because the page would become too large: the "
                                 "table below leads to them.",
                                 left_out_));
    }
    return html::section(2, "films", "The films in step", content);
  }

 private:
  Markup of(const SweepGrid& grid) {
    html::Table table{grid.title.empty() ? "Films by what varies" : "Films with " + grid.title, {}, {}};
    table.columns.push_back({grid.down == nullptr ? Markup() : html::code(grid.down->name)});
    for (std::size_t c = 0; c < grid.cells.front().size(); ++c) {
      table.columns.push_back(
          {grid.across == nullptr ? Markup() : html::code(grid.across->name) + " = " + grid.across->values[c]});
    }
    for (std::size_t r = 0; r < grid.cells.size(); ++r) {
      std::vector<Markup> line{grid.down == nullptr ? Markup() : Markup(grid.down->values[r])};
      for (const SweepRow* row : grid.cells[r]) line.push_back(row == nullptr ? Markup("–") : cell(*row));
      table.rows.push_back(std::move(line));
    }
    return (grid.title.empty() ? Markup() : html::element("h3", grid.title)) + html::table(table);
  }

  Markup cell(const SweepRow& row) {
    Markup film;
    std::optional<html::Strip> strip;
    if (bytes_ < most_film_bytes) strip = strip_of(results_, row, folder_);
    if (strip) {
      bytes_ += strip->bytes.size();
      note_moments(row.record.moments);
      film = html::strip(*strip);
    } else if (!row.record.moments.empty()) {
      ++left_out_;
    }
    if (row.record.outcome != RunOutcome::completed) film += outcome_badge(row.record.outcome);
    std::string figures = short_figure(row, "step_us.median");
    if (figures != "–") figures += " µs";
    if (const std::string iterations = short_figure(row, "iterations.mean");
        iterations != "–" && iterations != "0.00") {
      figures += ", " + iterations + " iterations";
    }
    const std::string file = film_of(results_, row);
    return film + html::note(file.empty() ? Markup(figures) : html::link(file, figures));
  }

  void note_moments(const std::vector<double>& moments) {
    const auto& [shorter, longer] =
        std::minmax(moments, moments_, [](const auto& a, const auto& b) { return a.size() < b.size(); });
    same_moments_ = same_moments_ && std::equal(shorter.begin(), shorter.end(), longer.begin());
    if (moments.size() > moments_.size()) moments_ = moments;
  }

  const SweepResults& results_;
  const std::filesystem::path& folder_;
  std::vector<double> moments_;  // times of the longest strip [s]
  bool same_moments_ = true;     // true if all strips share their common moments
  std::size_t bytes_ = 0, left_out_ = 0;
};

Markup figures_table(const SweepResults& results) {
  html::Table table{"Every run, with its figures", {{"Run", true}}, {}};
  const bool scenes = results.plan.names.size() > 1;
  if (scenes) table.columns.push_back({"Scene"});
  for (const Variation& variation : results.plan.request.varied) table.columns.push_back({html::code(variation.key)});
  table.columns.push_back({"Outcome"});
  std::vector<std::string> figures;
  for (const char* name : {"steps", "step_us.median", "iterations.mean", "iterations.max",
                           "iterations.steps_not_converged", "accuracy.estimated_error.mean"}) {
    const auto has = [&](const SweepRow& row) { return !row.record.figure(name).empty(); };
    if (std::ranges::any_of(results.rows, has)) figures.emplace_back(name);
  }
  for (const std::string& name : figures) table.columns.push_back({figure_title(name), true});
  table.columns.push_back({"Took [s]", true});
  table.columns.push_back({"Timed"});
  for (const SweepRow& row : results.rows) {
    const PlannedRun& planned = results.planned(row);
    const std::string film = film_of(results, row), number = std::to_string(row.run + 1);
    std::vector<Markup> cells{film.empty() ? Markup(number) : html::link(film, number)};
    if (scenes) cells.emplace_back(results.plan.names[planned.scene]);
    for (const std::string& value : planned.values) cells.emplace_back(value);
    cells.push_back(outcome_badge(row.record.outcome));
    for (const std::string& name : figures) cells.emplace_back(short_figure(row, name));
    cells.emplace_back(row.record.seconds > 0 ? fmt::format("{:.2f}", row.record.seconds) : "–");
    cells.emplace_back(row.record.timed.empty() ? "–" : row.record.timed);
    table.rows.push_back(std::move(cells));
  }
  return html::sortable_table(table);
}

Markup findings(const SweepResults& results) {
  constexpr std::size_t most_open = 4;
  std::vector<html::Finding> found;
  for (const std::string& trouble : results.troubles()) found.push_back({html::Tone::bad, trouble});
  if (found.empty()) return {};
  return found.size() <= most_open ? html::findings(found)
                                   : html::details("Why runs are not complete", html::findings(found));
}

}  // namespace

std::string sweep_page(const SweepResults& results, const std::filesystem::path& folder) {
  html::Page page;
  page.title = "drape sweep";
  page.kind = "drape sweep";
  page.heading = results.headline();
  if (!results.shard.whole()) page.heading += fmt::format(" (shard {})", results.shard.text());
  page.introduction = findings(results) + html::command("Reproduce this sweep", command_of(results.plan.request));
  page.content = Films(results, folder).section();
  if (const SweepDiagrams diagrams = figure_diagrams(results); !diagrams.charts.empty()) {
    page.content += html::section(2, "diagrams", "Diagrams",
                                  html::choices("figure-diagrams", choices_of(diagrams)) +
                                      html::note(fmt::format("Each is a file, too: {}/ has all of them as SVG, PDF and "
                                                             "PNG, with their points as CSV, Markdown and LaTeX.",
                                                             diagrams_place)));
  }
  page.content +=
      html::section(2, "figures", "Figures",
                    figures_table(results) +
                        html::element("p", {{"class", "note on-screen"}}, "Choose a column's head to sort by it.") +
                        html::note("runs.csv has every figure."));
  page.foot = {{"Made by", results.plan.program}};
  return html::render(page);
}

}  // namespace drape
