#include "study/homework.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "drape/sim/simulation.hpp"
#include "reports/chart.hpp"
#include "run/run_scene.hpp"

namespace drape {
namespace {

// Numbers of steps in the whole timeline, 250/30 s, for both step lengths.
constexpr std::int64_t steps = 417, small_steps = 8334;
// The report evaluates the first 167 steps of the implicit method with the sphere.
constexpr std::int64_t sphere_steps = 167;

constexpr const char* semi = "scenes/homework/1.toml";      // k = 18, damping 0.2
constexpr const char* newton18 = "scenes/homework/2.toml";  // implicit, k = 18
constexpr const char* newton = "scenes/homework/3.toml";    // implicit, k = 180
constexpr const char* liu1800 = "scenes/homework/4.toml";   // liu13, k = 1800
constexpr const char* sphere = "scenes/homework/5.toml";    // liu13, k = 180, sphere

HomeworkRow row(int table, const std::string& method, double step, const std::string& tolerance, Reported reported,
                const char* scene, std::vector<std::string> overrides, std::int64_t count) {
  std::string label = method;
  if (!tolerance.empty()) label += ", ε = " + tolerance;
  return {table, method, step, tolerance, reported, {std::move(label), scene, std::move(overrides), count}};
}

}  // namespace

std::vector<HomeworkRow> homework_rows() {
  std::vector<HomeworkRow> rows;
  rows.push_back(row(1, "semi-implicit", 0.001, "", {{}, {}, 27.68}, semi, {}, small_steps));
  rows.push_back(row(1, "implicit", 0.02, "1e-3", {3.29087, 3.2926, 11863.7}, newton18, {}, steps));
  rows.push_back(row(1, "liu13", 0.02, "1e-3", {6.19664, 7.1966, 498.456}, newton18,
                     {"integrator.method=liu13", "integrator.max_iterations=100"}, steps));

  rows.push_back(row(2, "semi-implicit", 0.001, "", {{}, {}, 29.63}, sphere,
                     {"integrator.method=semi-implicit", "time.step=0.001", "effects.damping.factor=0.2"},
                     small_steps));
  rows.push_back(row(2, "implicit", 0.02, "1e-3", {7.06966, 8.59, 24222.8}, sphere,
                     {"integrator.method=implicit", "integrator.max_iterations=20"}, sphere_steps));
  rows.push_back(row(2, "liu13", 0.02, "1e-3", {38.9329, 39.10, 2227.29}, sphere, {}, steps));

  struct Line {
    const char* tolerance;
    Reported implicit, liu13;
  };
  const std::array<Line, 6> lines{{{"1", {2, 2, 7244.6}, {2, 2, 202.981}},
                                   {"1e-1", {2.00719, 2.0072, 7396.92}, {2, 2, 198.715}},
                                   {"1e-2", {2.98561, 2.9856, 10210.5}, {2.18465, 2.1847, 213.396}},
                                   {"1e-3", {3.71703, 3.7122, 13196.2}, {9.09113, 9.0887, 619.432}},
                                   {"1e-4", {5, 5.0048, 18122.2}, {54.6866, 51.9976, 3015.32}},
                                   {"1e-5", {7.29496, 7.3070, 25914.2}, {100.892, 99.9, 5941.71}}}};
  for (const Line& l : lines) {
    rows.push_back(row(3, "implicit", 0.02, l.tolerance, l.implicit, newton,
                       {std::string("integrator.tolerance=") + l.tolerance}, steps));
  }
  for (const Line& l : lines) {
    rows.push_back(row(3, "liu13", 0.02, l.tolerance, l.liu13, liu1800,
                       {"cloth.stiffness=180", std::string("integrator.tolerance=") + l.tolerance}, steps));
  }
  return rows;
}

std::vector<StudyCase> homework_extras() {
  return {{"semi-implicit, undamped", semi, {"effects.damping.factor=1"}, small_steps},
          {"semi-implicit, half the step", semi, {"time.step=0.0005"}, 2 * small_steps},
          {"semi-implicit, k = 180", semi, {"cloth.stiffness=180"}, small_steps}};
}

namespace {

/// Returns the case of the report's energy log: semi-implicit, k = 180, undamped, 20 steps.
StudyCase homework_energy_case() {
  return {"semi-implicit, k = 180, undamped", semi, {"cloth.stiffness=180", "effects.damping.factor=1"}, 20};
}

constexpr std::array<const char*, 3> titles{"Table 1: no sphere, k = 18 N/m", "Table 2: with the sphere, k = 180 N/m",
                                            "Table 3: no sphere, k = 180 N/m, by tolerance ε"};

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : "–"; }

std::string microseconds(double value) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, value < 100 ? 2 : 0) : "–";
}

ResultTable make_table(int table, const std::vector<HomeworkRow>& rows, const std::vector<Measured>& measured) {
  ResultTable result{fmt::format("table{}", table),
                     titles[static_cast<std::size_t>(table - 1)],
                     {"method", "h [s]", "ε [m]", "iterations: report", "its code again", "drape", "capped steps",
                      "µs per step: report", "drape", "from", "to", "runs", "times faster"},
                     {},
                     {}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HomeworkRow& r = rows[i];
    if (r.table != table) continue;
    const MedianInterval time = measured[i].time();
    const bool iterates = r.reported.iterations.has_value();
    result.rows.push_back(
        {r.method, fmt::format("{:g}", r.step), r.tolerance.empty() ? "–" : r.tolerance, number(r.reported.iterations),
         number(r.reported.again), iterates ? fmt::format("{:.4f}", measured[i].mean_iterations()) : "–",
         iterates ? fmt::format("{}", measured[i].capped) : "–", number(r.reported.microseconds),
         microseconds(time.median), microseconds(time.lower), microseconds(time.upper), fmt::format("{}", time.count),
         fmt::format("{:.1f}", r.reported.microseconds / time.median)});
  }
  if (table == 2) result.notes.push_back("The implicit method is measured over its first 167 steps, as in the report.");
  result.notes.emplace_back(interval_note);
  return result;
}

/// A row of the report's energy log [J].
struct EnergyRow {
  std::int64_t step;
  double total, kinetic, gravity, elastic;
};
constexpr std::array<EnergyRow, 6> reported_energies{{{1, -4.7802e-05, 4.78023e-05, -9.56045e-05, 1.86e-10},
                                                      {5, -0.000239011, 0.00119506, -0.00143407, 2.07e-10},
                                                      {10, -0.000478022, 0.00478022, -0.00525825, 7.51e-10},
                                                      {13, -0.000621427, 0.00807857, -0.0087, 4.179e-09},
                                                      {16, -0.000764831, 0.0122374, -0.0130022, 1.8299e-08},
                                                      {20, -0.000956025, 0.0191208, -0.0200769, 9.40691e-08}}};

void add_energies(HomeworkStudy& study) {
  const StudyCase study_case = homework_energy_case();
  Simulation simulation(study_case.load().simulation);
  study.energies = {
      "energies", "Energies of the first steps [J]", {"step", "total", "kinetic", "gravity", "elastic"}, {}, {}};
  ResultTable beside{
      "energy-log",
      "Energy log: semi-implicit, h = 0.001 s, k = 180 N/m, no damping [J]",
      {"step", "total: report", "drape", "kinetic: report", "drape", "gravity: report", "drape", "elastic: report",
       "drape"},
      {},
      {"The report's positions are in single precision, which leaves noise of about 2e-10 J in its elastic energy. The "
       "steady loss is that of the scheme, ½ M g² h² = 4.78e-5 J per step in free fall, not damping.",
       study_case.command() + " --energies energies.csv"}};
  run_steps(simulation, study_case.steps, {}, [&](const StepReport&) {
    const std::int64_t step = simulation.state().step;
    const Energies e = simulation.energies();
    const auto text = [](double value) { return fmt::format("{:.6g}", value); };
    study.energies.rows.push_back({fmt::format("{}", step), fmt::format("{:.17g}", e.total()),
                                   fmt::format("{:.17g}", e.kinetic), fmt::format("{:.17g}", e.gravity),
                                   fmt::format("{:.17g}", e.elastic)});
    for (const EnergyRow& r : reported_energies) {
      if (r.step != step) continue;
      beside.rows.push_back({fmt::format("{}", step), text(r.total), text(e.total()), text(r.kinetic), text(e.kinetic),
                             text(r.gravity), text(e.gravity), text(r.elastic), text(e.elastic)});
    }
  });
  study.tables.push_back(std::move(beside));
}

html::ChartSeries iterations_of(const Measured& measured, const std::string& name) {
  html::ChartSeries series = method_series(name);
  series.markers = false;
  series.command = measured.study_case.command();
  for (std::size_t i = 0; i < measured.iterations.size(); ++i) {
    const double time = static_cast<double>(i + 1) * measured.step;
    series.points.push_back({time,
                             static_cast<double>(measured.iterations[i]),
                             fmt::format("step {} at {:.2f} s: {} iterations", i + 1, time, measured.iterations[i]),
                             {}});
  }
  return series;
}

/// @param every steps per point
html::ChartSeries height_of(const Measured& measured, const std::string& name, std::size_t every) {
  html::ChartSeries series = method_series(name);
  series.markers = false;
  series.command = measured.study_case.command();
  for (std::size_t i = every - 1; i < measured.height.size(); i += every) {
    const double time = static_cast<double>(i + 1) * measured.step;
    series.points.push_back(
        {time, measured.height[i], fmt::format("{:.2f} s: {:.3f} m", time, measured.height[i]), {}});
  }
  return series;
}

NamedChart over_time(const char* name, const char* title, const char* y_title, std::vector<html::ChartSeries> series) {
  using enum html::Scale;
  return {name, {title, "time [s]", y_title, linear, linear, std::move(series), {}}};
}

/// Plots a column of table 3 against the tolerance for every method, beside the report's own values.
/// @param ours, reported  functions that return the value of a row
template <class Ours, class Reported>
NamedChart by_tolerance(const char* name, const char* title, const char* y_title, const std::vector<HomeworkRow>& rows,
                        const std::vector<Measured>& measured, Ours ours, Reported reported) {
  using enum html::Scale;
  NamedChart chart{name, {title, "tolerance ε [m]", y_title, logarithmic, logarithmic, {}, {}}};
  const auto add = [&](const std::string& method, const char* source, const auto& value) {
    html::ChartSeries series = method_series(method + source);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].table != 3 || rows[i].method != method) continue;
      const double y = value(i);
      series.points.push_back({std::stod(rows[i].tolerance), y, fmt::format("ε = {}: {:.5g}", rows[i].tolerance, y),
                               measured[i].study_case.command()});
    }
    chart.chart.series.push_back(std::move(series));
  };
  for (const char* method : {"implicit", "liu13"}) add(method, "", [&](std::size_t i) { return ours(measured[i]); });
  for (const char* method : {"implicit", "liu13"}) {
    add(method, ", report", [&](std::size_t i) { return reported(rows[i].reported); });
  }
  return chart;
}

void add_charts(HomeworkStudy& study, const std::vector<HomeworkRow>& rows, const std::vector<Measured>& measured,
                const std::vector<Measured>& extras) {
  const Measured& soft = measured[find_row(rows, 1, "implicit")];
  const Measured& soft_liu13 = measured[find_row(rows, 1, "liu13")];
  const Measured& newton = measured[find_row(rows, 3, "implicit", "1e-3")];
  const Measured& liu13 = measured[find_row(rows, 3, "liu13", "1e-3")];
  const Measured& undamped = extras.at(static_cast<std::size_t>(Extra::undamped));
  study.charts = {
      over_time("iterations-k18", "Iterations per step over time, k = 18 N/m, ε = 1e-3 m.", "iterations",
                {iterations_of(soft, "implicit"), iterations_of(soft_liu13, "liu13")}),
      over_time("height-k18", "Height of the centre of mass, k = 18 N/m, by both methods.", "height [m]",
                {height_of(soft, "implicit", 1), height_of(undamped, "semi-implicit, undamped", 20)}),
      over_time("iterations-k180", "Iterations per step over time, k = 180 N/m, ε = 1e-3 m.", "iterations",
                {iterations_of(newton, "implicit"), iterations_of(liu13, "liu13")}),
      by_tolerance(
          "iterations-by-tolerance", "Mean iterations per step against tolerance (table 3).", "iterations per step",
          rows, measured, [](const Measured& m) { return m.mean_iterations(); },
          [](const Reported& r) { return r.iterations.value_or(0); }),
      by_tolerance(
          "time-by-tolerance", "Time per step against tolerance (table 3).", "time per step [µs]", rows, measured,
          [](const Measured& m) { return m.time().median; }, [](const Reported& r) { return r.microseconds; })};
}

/// Runs each method of tables 1 and 2 once more and records its motion.
/// @returns false if stopped
bool add_motions(HomeworkStudy& study, const std::vector<HomeworkRow>& rows, const std::stop_token& stop,
                 Progress& progress) {
  progress.begin("running for the motions", "motions",
                 std::ranges::count_if(rows, [](const HomeworkRow& row) { return row.table < 3; }));
  for (const HomeworkRow& row : rows) {
    if (row.table == 3) continue;
    auto motion = record_study_motion(
        row.study_case, row.method + (row.table == 1 ? ", no sphere, k = 18 N/m" : ", with the sphere, k = 180 N/m"),
        stop);
    if (!motion) return false;
    study.motions.push_back(std::move(*motion));
    ++progress.done;
  }
  return true;
}

/// Returns the intended differences between drape and the report, one sentence each.
std::vector<std::string> homework_differences() {
  return {
      // NOLINTNEXTLINE(bugprone-suspicious-missing-comma): there is one after each sentence
      "drape also holds pins in Liu13's first local step, where the report's code lets them move. With pins held "
      "throughout, the report's code takes 2, 2, 2.295, 9.307, 52.12 and 99.64 iterations in table 3 and 7.240 in "
      "table 1.",
      "A step that ends at the limit of 100 iterations counts as 100; the report counts 101. The report's table 1 "
      "gives Liu13 one iteration too few.",
      "Newton's method evaluates all terms of its first iteration at its starting point y. The report's code evaluates "
      "the elastic ones at the last positions, and needs more iterations. Compressed springs keep the stiffness k x̂x̂ᵀ, "
      "as in the course's notes; the report's code scales it by L/‖x‖.",
      "With the sphere the implicit method's count is sensitive: the report prints 7.07, but its own code (the "
      "column \"its code again\") gives 8.59 when run again.",
      "The report's times are from its author's machine; drape's are CPU times of one thread on the machine below."};
}

}  // namespace

std::optional<HomeworkStudy> study_homework(RunCount runs, const std::stop_token& stop, Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<HomeworkRow> rows = homework_rows();
  std::vector<StudyCase> cases;
  for (const HomeworkRow& row : rows) cases.push_back(row.study_case);
  for (StudyCase& extra : homework_extras()) cases.push_back(std::move(extra));
  std::vector<Measured> measured = measure(cases, runs, stop, progress);
  if (measured.empty()) return std::nullopt;
  const std::vector<Measured> extras(measured.begin() + static_cast<std::ptrdiff_t>(rows.size()), measured.end());
  measured.resize(rows.size());

  HomeworkStudy study;
  study.runs = runs;
  for (const int table : {1, 2, 3}) study.tables.push_back(make_table(table, rows, measured));
  add_energies(study);
  add_charts(study, rows, measured, extras);
  if (!add_motions(study, rows, stop, progress)) return std::nullopt;
  study.conclusions = judge_conclusions(rows, measured, extras);
  study.differences = homework_differences();
  study.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return study;
}

namespace {

/// Threshold for visible flipped pairs per frame, more than one pair in two frames; the report's Liu13 has about four.
constexpr double visible_pairs = 0.5;

std::string per_frame(double pairs) { return pairs > 0 ? fmt::format("{:.2g}", pairs) : "none"; }

/// Returns the root mean square of a(t) − b(t) over the first `seconds`, at the coarser steps, relative to the range of
/// `a` in that time.
double relative_distance(const Measured& a, const Measured& b, double seconds) {
  const Measured& coarse = a.step > b.step ? a : b;
  const auto at = [](const Measured& m, double time) {
    return m.height[static_cast<std::size_t>(std::lround(time / m.step)) - 1];
  };
  double sum = 0, low = INFINITY, high = -INFINITY;
  int count = 0;
  for (double time = coarse.step; time < seconds; time = ++count * coarse.step + coarse.step) {
    sum += std::pow(at(a, time) - at(b, time), 2);
    low = std::min(low, at(a, time));
    high = std::max(high, at(a, time));
  }
  return std::sqrt(sum / count) / (high - low);
}

/// Returns the mean iterations of steps with the centre of mass in the lowest and in the highest quarter of its range.
std::pair<double, double> iterations_low_and_high(const Measured& m) {
  const auto [low, high] = std::minmax_element(m.height.begin(), m.height.end());
  const double range = *high - *low;
  std::pair<double, double> sums{}, counts{};
  for (std::size_t i = 0; i < m.height.size(); ++i) {
    if (m.height[i] < *low + range / 4) sums.first += m.iterations[i], ++counts.first;
    if (m.height[i] > *high - range / 4) sums.second += m.iterations[i], ++counts.second;
  }
  return {sums.first / counts.first, sums.second / counts.second};
}

/// Measurements by table, method and tolerance.
class Results {
 public:
  Results(const std::vector<HomeworkRow>& rows, const std::vector<Measured>& tables) : rows_(rows), tables_(tables) {}
  const Measured& operator()(int table, const std::string& method, const std::string& tolerance = "") const {
    return tables_[find_row(rows_, table, method, tolerance)];
  }

 private:
  const std::vector<HomeworkRow>& rows_;
  const std::vector<Measured>& tables_;
};

Conclusion implicit_looks_right(const Results& of) {
  const double pairs = of(3, "implicit", "1").flipped_pairs;
  return {"Implicit Euler looks right even at ε = 1.", pairs < visible_pairs,
          fmt::format("Flipped pairs of triangles per frame: {} at ε = 1, {} at ε = 1e-5.", per_frame(pairs),
                      per_frame(of(3, "implicit", "1e-5").flipped_pairs))};
}

Conclusion liu13_flips(const Results& of) {
  const double one = of(3, "liu13", "1").flipped_pairs, tenth = of(3, "liu13", "1e-1").flipped_pairs,
               tight = of(3, "liu13", "1e-4").flipped_pairs;
  return {"Liu13 flips triangles over at ε = 1 or 0.1.",
          one > visible_pairs && tenth > visible_pairs && tight < visible_pairs,
          fmt::format("Pairs per frame: {} at ε = 1, {} at 0.1, {} at 1e-2, {} at 1e-3, {} at 1e-4.", per_frame(one),
                      per_frame(tenth), per_frame(of(3, "liu13", "1e-2").flipped_pairs),
                      per_frame(of(3, "liu13", "1e-3").flipped_pairs), per_frame(tight))};
}

Conclusion liu13_slows_down(const Results& of) {
  const double one = of(3, "liu13", "1").mean_iterations(), hundredth = of(3, "liu13", "1e-2").mean_iterations(),
               thousandth = of(3, "liu13", "1e-3").mean_iterations(), next = of(3, "liu13", "1e-4").mean_iterations();
  const double newton = of(3, "implicit", "1e-4").mean_iterations() - of(3, "implicit", "1e-3").mean_iterations();
  return {"Liu13 converges quickly at first, then slowly.", hundredth - one < 1 && next - thousandth > 10 * newton,
          fmt::format("From ε = 1 to 1e-2 it needs {:.2f} more iterations, from 1e-3 to 1e-4 {:.1f} more; Newton's "
                      "method needs {:.2f} more there.",
                      hundredth - one, next - thousandth, newton)};
}

Conclusion sphere_slows_down(const Results& of, const Measured& semi_without) {
  const Measured &newton = of(2, "implicit"), &liu13 = of(2, "liu13"), &semi = of(2, "semi-implicit");
  const auto steps = static_cast<std::size_t>(newton.study_case.steps);
  const double newton_before = of(3, "implicit", "1e-3").mean_iterations(0, steps);
  const double liu13_before = of(3, "liu13", "1e-3").mean_iterations();
  const double before = semi_without.time().median, with = semi.time().median;
  return {
      "The sphere makes every method slower.",
      newton.mean_iterations() > newton_before && liu13.mean_iterations() > liu13_before && with > before,
      fmt::format("Iterations: implicit {:.2f} → {:.2f} over the first {} steps, liu13 {:.2f} → {:.2f}. Semi-implicit: "
                  "{:.2f} µs → {:.2f} µs per step.",
                  newton_before, newton.mean_iterations(), steps, liu13_before, liu13.mean_iterations(), before, with)};
}

Conclusion newton_at_the_lowest_point(const Results& of) {
  const auto [soft_low, soft_high] = iterations_low_and_high(of(1, "implicit"));
  const auto [low, high] = iterations_low_and_high(of(3, "implicit", "1e-3"));
  return {"Newton's method needs more iterations when the cloth swings through its lowest point.",
          soft_low > soft_high && low > high,
          fmt::format("With the centre of mass in the lowest and in the highest quarter of its range: {:.2f} and "
                      "{:.2f} iterations per step at k = 18, {:.2f} and {:.2f} at k = 180.",
                      soft_low, soft_high, low, high)};
}

Conclusion implicit_looks_like_semi_implicit(const Results& of, const Measured& undamped) {
  constexpr double seconds = 2;
  const double distance = relative_distance(undamped, of(1, "implicit"), seconds);
  return {
      "The implicit motion looks like the semi-implicit one.", distance < 0.1,
      fmt::format("Without damping and with k = 18, the heights of the two centres of mass differ by {:.1f}% (RMS) of "
                  "their range over the first {:g} s.",
                  100 * distance, seconds)};
}

Conclusion damping_at_any_step(const Results& of, const Measured& half) {
  constexpr double seconds = 8;
  const double distance = relative_distance(of(1, "semi-implicit"), half, seconds);
  return {
      "Damping looks the same at any time step.", distance < 0.02,
      fmt::format("Semi-implicit with h = 0.001 s and 0.0005 s, damped by 0.2: the heights of the two centres of mass "
                  "differ by {:.3f}% (RMS) of their range over {:g} s.",
                  100 * distance, seconds)};
}

}  // namespace

std::size_t find_row(const std::vector<HomeworkRow>& rows, int table, const std::string& method,
                     const std::string& tolerance) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HomeworkRow& r = rows[i];
    if (r.table == table && r.method == method && (tolerance.empty() || r.tolerance == tolerance)) return i;
  }
  throw std::out_of_range("no such row in the homework's tables");
}

std::vector<Conclusion> judge_conclusions(const std::vector<HomeworkRow>& rows, const std::vector<Measured>& tables,
                                          const std::vector<Measured>& extras) {
  const Results of(rows, tables);
  const auto extra = [&](Extra which) -> const Measured& { return extras.at(static_cast<std::size_t>(which)); };
  return {implicit_looks_right(of),
          liu13_flips(of),
          liu13_slows_down(of),
          sphere_slows_down(of, extra(Extra::no_sphere)),
          newton_at_the_lowest_point(of),
          implicit_looks_like_semi_implicit(of, extra(Extra::undamped)),
          damping_at_any_step(of, extra(Extra::half_step))};
}

StudyReport homework_report(const HomeworkStudy& study) {
  const auto confirmed = std::count_if(study.conclusions.begin(), study.conclusions.end(),
                                       [](const Conclusion& c) { return c.confirmed; });
  StudyReport report;
  report.kind = report.command = "drape study homework";
  report.title = "The homework's results, measured again";
  report.headline = fmt::format("{} of the report's {} conclusions are confirmed", confirmed, study.conclusions.size());
  report.introduction =
      "drape grew out of a course's homework: mass-spring cloth of 20×20 cells, 8.34 s of motion, by two implicit "
      "methods and an explicit one. In tables, \"report\" is what the report on that homework printed, \"its code "
      "again\" what its program gives when it is compiled and run today, and \"drape\" what was measured just now. In "
      "diagrams, the report's figures are dashed, in the colour of their method.";
  for (const Conclusion& c : study.conclusions) {
    report.findings.push_back({c.confirmed ? html::Tone::good : html::Tone::bad,
                               c.confirmed ? "confirmed" : "Not confirmed.", c.claim, c.figures});
  }
  report.sections = {
      {"Tables", {}, study.tables, {}, {}},
      {.title = "Motions", .text = {}, .tables = {}, .charts = {}, .pictures = {}, .motions = study.motions},
      {"Diagrams", {}, {}, study.charts, {}},
      {"Where drape differs on purpose", study.differences, {}, {}, {}},
      {"How it was measured", {describe_measuring(study.runs)}, {}, {}, {}}};
  report.data = {study.energies};
  report.seconds = study.seconds;
  return report;
}

}  // namespace drape
