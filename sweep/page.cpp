#include "sweep/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/render/image.hpp"
#include "output/codecs/codecs.hpp"
#include "reports/chart.hpp"
#include "reports/listing.hpp"
#include "reports/page.hpp"
#include "reports/players.hpp"
#include "run/frame_source.hpp"
#include "run/outputs.hpp"
#include "sweep/results.hpp"

namespace drape {
namespace {

Camera usual_side() { return {.azimuth = Camera::usual_azimuth, .elevation = Camera::usual_elevation}; }

}  // namespace

bool chooses_side(const SweepRequest& request, const Camera& camera) {
  return !request.films.empty() && !camera.position && !(camera.azimuth && camera.elevation);
}

std::string key_seen_from(const std::string& key, const std::string& side) {
  if (side.empty() || side == key) return key;
  return checksum_of(key + ", seen as " + side);
}

Camera side_of_films(const SweepPlan& plan, const std::stop_token& stop) {
  struct Stopped {};
  const PlannedRun& run = plan.runs.at(plan.side.value());
  try {
    const Scene scene = load_scene(plan.request.scenes[run.scene], overrides_of(plan, run));
    const FilmExtent extent = film_extent(scene, run_options(plan.request, {}));
    FrameSource motion(scene, nullptr, extent, std::nullopt);  // a single pass, by well_placed()
    return well_placed(scene.camera, known_film(scene, scene.video.size, extent.frames.count(), [&](const auto& visit) {
                         motion.pass(visit, stop);
                         if (stop.stop_requested()) throw Stopped();
                       }));
  } catch (const Stopped&) {
    return usual_side();  // no more drawing follows
  } catch (const Error&) {
    return usual_side();  // that run's own row has the reason
  } catch (const std::bad_alloc&) {
    return usual_side();
  }
}

void look_from(const Camera& side, Camera& camera) {
  if (!camera.azimuth) camera.azimuth = side.azimuth;
  if (!camera.elevation) camera.elevation = side.elevation;
}

namespace {

constexpr std::size_t most_lines = 12;
constexpr double wide = 30;  // ratio of largest to smallest value that makes an axis logarithmic

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Returns the values of an axis as numbers; empty if any is not a number.
std::vector<double> numbers_of(const SweepAxis& axis) {
  std::vector<double> values;
  for (const std::string& text : axis.values) {
    const auto value = number(text);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

html::Scale scale_of(const std::vector<double>& values) {
  double low = INFINITY, high = 0;
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return low > 0 && high >= wide * low ? html::Scale::logarithmic : html::Scale::linear;
}

/// Returns the numeric figures that vary, in the order of the runs' records.
std::vector<std::string> changing_figures(const SweepResults& results) {
  std::vector<std::string> names;
  std::map<std::string, std::set<std::string>> values;
  for (const SweepRow& row : results.rows) {
    for (const auto& [name, value] : row.record.figures) {
      if (!number(value)) continue;
      if (values[name].empty()) names.push_back(name);
      values[name].insert(value);
    }
  }
  std::erase_if(names, [&](const std::string& name) { return values[name].size() < 2; });
  // The first figure is shown first.
  const auto preferred = [](const std::string& name) {
    return name == "step_us.median" ? 0 : name == "iterations.mean" ? 1 : 2;
  };
  std::ranges::stable_sort(names, std::less(), preferred);
  return names;
}

/// Returns the axes that distinguish the lines of a diagram over one axis.
std::vector<std::size_t> line_axes(const SweepResults& results, std::size_t over) {
  std::vector<std::size_t> others;
  std::size_t lines = 1;
  for (std::size_t a = 0; a < results.axes.size(); ++a) {
    if (a == over) continue;
    others.push_back(a);
    lines *= results.axes[a].values.size();
  }
  if (lines <= most_lines) return others;
  std::ranges::reverse(others);  // among equals, prefer the axis that changes fastest
  const std::size_t fewest =
      *std::ranges::min_element(others, std::less(), [&](std::size_t a) { return results.axes[a].values.size(); });
  return {fewest};
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Returns a file name that needs no quotes in any context.
std::string file_name(std::string text) {
  const auto strange = [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-' && c != '.'; };
  std::ranges::replace_if(text, strange, '-');
  return text;
}

NamedChart diagram(const SweepResults& results, const std::string& figure, std::size_t over) {
  using Line = std::map<double, std::vector<double>>;  // the figure's values by place on the axis
  const SweepAxis& axis = results.axes[over];
  const std::vector<double> numbers = numbers_of(axis);
  const std::vector<std::size_t> apart = line_axes(results, over);
  std::map<std::vector<std::size_t>, Line> lines;
  std::vector<double> all;
  bool medians = false;
  for (const SweepRow& row : results.rows) {
    const auto value = number(row.record.figure(figure));
    if (!value) continue;
    std::vector<std::size_t> line;
    for (const std::size_t a : apart) line.push_back(row.places[a]);
    const std::size_t place = row.places[over];
    std::vector<double>& values = lines[line][numbers.empty() ? static_cast<double>(place) : numbers[place]];
    values.push_back(*value);
    medians = medians || values.size() > 1;
    all.push_back(*value);
  }
  html::Chart chart;
  chart.title =
      fmt::format("{} over {}{}", figure_title(figure), axis.name, medians ? ", medians over the other keys" : "");
  chart.x_title = axis.name;
  chart.y_title = figure_title(figure);
  chart.y_scale = scale_of(all);
  if (numbers.empty()) {
    chart.x_names = axis.values;
  } else {
    chart.x_scale = scale_of(numbers);
  }
  for (const auto& [places, line] : lines) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < apart.size(); ++i) {
      const SweepAxis& other = results.axes[apart[i]];
      parts.push_back(fmt::format("{} {}", other.name.substr(other.name.rfind('.') + 1), other.values[places[i]]));
    }
    html::ChartSeries series;
    const bool by_method = apart.size() == 1 && results.axes[apart[0]].name == "integrator.method";
    if (by_method) series = method_series(results.axes[apart[0]].values[places[0]]);
    series.name = fmt::format("{}", fmt::join(parts, ", "));
    for (const auto& [x, values] : line) {
      const double y = median(values);
      const std::string at = numbers.empty() ? axis.values[static_cast<std::size_t>(x)] : fmt::format("{:.6g}", x);
      series.points.push_back({x, y, fmt::format("{} = {}: {:.4g}", axis.name, at, y), {}});
    }
    if (!by_method) series.other = chart.series.size() >= 6;  // there are six colours
    chart.series.push_back(std::move(series));
  }
  return {file_name(fmt::format("{}-over-{}", figure, axis.name)), std::move(chart)};
}

}  // namespace

std::string figure_title(const std::string& name) {
  static const std::map<std::string, std::string> titles{
      {"step_us.median", "µs per step (median)"},
      {"step_us.mean", "µs per step (mean)"},
      {"iterations.mean", "iterations per step"},
      {"iterations.max", "most iterations of a step"},
      {"iterations.steps_not_converged", "steps that did not converge"},
      {"iterations.steps_redone", "steps redone by backward Euler"},
      {"iterations.worst_residual", "worst residual [N]"},
      {"accuracy.estimated_error.mean", "estimated error of a step [m]"},
      {"accuracy.estimated_error.largest", "largest estimated error of a step [m]"},
      {"accuracy.substeps.mean", "substeps per step"},
      {"accuracy.unbalanced_at_rest.force", "unbalanced force at rest [N]"}};
  const auto found = titles.find(name);
  return found == titles.end() ? name : found->second;
}

SweepDiagrams figure_diagrams(const SweepResults& results) {
  SweepDiagrams diagrams{.figures = changing_figures(results), .axes = {}, .charts = {}};
  for (const SweepAxis& axis : results.axes) diagrams.axes.push_back(axis.name);
  for (const std::string& figure : diagrams.figures) {
    for (std::size_t a = 0; a < diagrams.axes.size(); ++a) diagrams.charts.push_back(diagram(results, figure, a));
  }
  return diagrams;
}

html::Choices choices_of(const SweepDiagrams& diagrams) {
  html::Choices choices;
  std::vector<std::string> titles;
  for (const std::string& figure : diagrams.figures) titles.push_back(figure_title(figure));
  choices.lists = {{"Figure", titles}, {"over", diagrams.axes}};
  for (std::size_t i = 0; i < diagrams.charts.size(); ++i) {
    choices.pieces.push_back(
        {{i / diagrams.axes.size(), i % diagrams.axes.size()}, html::chart(diagrams.charts[i].chart)});
  }
  return choices;
}

std::string write_sweep_report(const SweepResults& results, const std::filesystem::path& folder, FigureStyle style) {
  write_file_atomically(folder / "runs.csv", runs_csv(results));
  write_file_atomically(folder / "report.md", sweep_markdown(results));
  write_file_atomically(folder / "table.tex", sweep_latex(results));
  std::string problem;
  for (const NamedChart& chart : figure_diagrams(results).charts) {
    const std::string missing = write_chart(chart, folder / diagrams_place, style);
    if (problem.empty()) problem = missing;
  }
  write_file_atomically(folder / sweep_page_name, sweep_page(results, folder));
  return problem;
}

namespace {

using html::Markup;

constexpr std::size_t most_sheet_bytes = std::size_t{1} << 28;
constexpr double most_sheet_pixels = 1 << 28;        // larger ones are not drape's
constexpr std::size_t most_film_bytes = 48'000'000;  // total on a page
constexpr int widest = 240;                          // width of a film's picture on the page [pixels]
constexpr int gap = 6;                               // gap between the pictures of a contact sheet [pixels]

/// A run's film for the page.
struct RunFilm {
  html::Strip strip;
  std::string poster;  ///< picture of the strip's poster: bytes of a PNG file
};

std::string png_bytes(const cv::Mat& picture) {
  const std::vector<std::uint8_t> png = png_from_bgr(picture);
  return {png.begin(), png.end()};
}

/// Returns a run's contact sheet for the page, scaled down and without gaps; nothing if it has none.
std::optional<RunFilm> film_on_page(const SweepResults& results, const SweepRow& row,
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
  cv::Mat strip(rows * small.height, columns * small.width, CV_8UC3, cv::Scalar::all(255)), first, telling;
  int poster = 0;
  double most = 0;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns, line = i / columns;
    const cv::Mat from = sheet(cv::Rect(column * (width + gap), line * (height + gap), width, height));
    cv::Mat to = strip(cv::Rect(column * small.width, line * small.height, small.width, small.height));
    cv::resize(from, to, small, 0, 0, cv::INTER_AREA);
    if (first.empty()) first = telling = to.clone();
    // Use the picture that differs most from the first as the poster, since most films begin with a flat cloth.
    const double differs = cv::norm(to, first, cv::NORM_L1);
    if (differs <= most) continue;
    most = differs;
    poster = i;
    telling = to.clone();
  }
  return RunFilm{.strip = {.bytes = png_bytes(strip),
                           .columns = columns,
                           .count = count,
                           .size = {small.width, small.height},
                           .poster = poster,
                           .alt = "Film of " + label_of(results.plan, results.planned(row))},
                 .poster = png_bytes(telling)};
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
    double spacing = 1;
    for (std::size_t i = 1; i < moments_.size(); ++i) spacing = std::min(spacing, moments_[i] - moments_[i - 1]);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      names.push_back(same_moments_ ? "t = " + readable_time(moments_[i], spacing)
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

  /// Returns the picture of a run that stands for its film; empty if section() shows no film of it.
  [[nodiscard]] Markup poster(const SweepRow& row) const {
    const auto found = posters_.find(row.run);
    if (found == posters_.end()) return {};
    return html::picture("image/png", found->second, "Picture of " + label_of(results_.plan, results_.planned(row)));
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
    std::optional<RunFilm> found;
    if (bytes_ < most_film_bytes) found = film_on_page(results_, row, folder_);
    if (found) {
      bytes_ += found->strip.bytes.size();
      note_moments(row.record.moments);
      film = html::strip(found->strip);
      posters_[row.run] = std::move(found->poster);
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
    if (figures == "–" && file.empty()) return film.empty() ? Markup(figures) : film;
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
  std::map<std::size_t, std::string> posters_;  // PNG files by run
  std::vector<double> moments_;                 // times of the longest strip [s]
  bool same_moments_ = true;                    // true if all strips share their common moments
  std::size_t bytes_ = 0, left_out_ = 0;
};

std::string anchor(const SweepRow& row) { return fmt::format("run-{}", row.run + 1); }

/// Returns a row per run, which begins with a link to the run's section.
html::Table runs_table(const SweepResults& results) {
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
    std::vector<Markup> cells{html::link("#" + anchor(row), std::to_string(row.run + 1))};
    if (scenes) cells.emplace_back(results.plan.names[planned.scene]);
    for (const std::string& value : planned.values) cells.emplace_back(value);
    cells.push_back(outcome_badge(row.record.outcome));
    for (const std::string& name : figures) cells.emplace_back(short_figure(row, name));
    cells.emplace_back(row.record.seconds > 0 ? fmt::format("{:.2f}", row.record.seconds) : "–");
    cells.emplace_back(row.record.timed.empty() ? "–" : row.record.timed);
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// Returns what is known about a run: how to repeat it, its picture and every figure.
Markup run_content(const SweepResults& results, const SweepRow& row, const Markup& poster) {
  const PlannedRun& planned = results.planned(row);
  Markup content;
  if (!row.record.reason.empty()) content += html::findings({{html::Tone::bad, row.record.reason}});
  content += html::command("Make this run alone", run_command(results.plan, planned));
  const std::string film = film_of(results, row);
  if (!poster.empty()) content += html::element("div", {{"class", "poster"}}, poster);
  if (!film.empty()) content += html::paragraph(html::link(film, "Its film"));
  std::vector<std::pair<std::string, Markup>> facts;
  for (const auto& [name, value] : row.record.figures) {
    if (!value.empty()) facts.emplace_back(figure_title(name), number(value) ? short_figure(row, name) : value);
  }
  return content + (facts.empty() ? Markup() : html::facts(facts));
}

/// Returns the list of runs, with a section for each.
Markup run_list(const SweepResults& results, const Films& films) {
  html::Listing listing{"runs", runs_table(results), {}, true};
  for (const SweepRow& row : results.rows) {
    const Markup heading = Markup(fmt::format("{}: {}", row.run + 1, label_of(results.plan, results.planned(row)))) +
                           outcome_badge(row.record.outcome);
    listing.entries.push_back(
        {anchor(row), name_of(row.record.outcome),
         html::section(3, anchor(row), heading,
                       html::details("Command, picture and figures", run_content(results, row, films.poster(row))))});
  }
  return html::listing(listing);
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
  page.introduction = findings(results) + html::command("Run this sweep again", results.command());
  Films films(results, folder);
  page.content = films.section();
  if (const SweepDiagrams diagrams = figure_diagrams(results); !diagrams.charts.empty()) {
    page.content += html::section(2, "diagrams", "Diagrams",
                                  html::choices("figure-diagrams", choices_of(diagrams)) +
                                      html::note(fmt::format("Each is a file, too: {}/ has all of them as SVG, PDF and "
                                                             "PNG, with their points as CSV, Markdown and LaTeX.",
                                                             diagrams_place)));
  }
  page.content +=
      html::section(2, "figures", "Figures",
                    run_list(results, films) +
                        html::element("p", {{"class", "note on-screen"}}, "Choose a column's head to sort by it.") +
                        html::note("runs.csv has every figure."));
  page.foot = {{"Made by", results.plan.program}};
  return html::render(page);
}

}  // namespace drape
