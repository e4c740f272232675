#include "study/scaling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "reports/chart.hpp"
#include "run/run_scene.hpp"
#include "sim/linear/constant_factor.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "study/measure.hpp"
#include "study/profile.hpp"

namespace drape {
namespace {

constexpr const char* scene_file = "scenes/homework/5.toml";
constexpr std::int64_t warm_up = 25;     // steps of 0.02 s, until the cloth lies on the sphere
constexpr std::int64_t timed_steps = 5;  // steps per run
constexpr double of_safe_step = 0.9;

struct Variant {
  const char* name;
  std::vector<std::string> overrides;
};

std::vector<Variant> variants() {
  return {{"semi-implicit", {"integrator.method=semi-implicit"}},
          {"implicit", {"integrator.method=implicit", "integrator.max_iterations=100"}},
          {"implicit, cholesky",
           {"integrator.method=implicit", "integrator.linear_solver=cholesky", "integrator.max_iterations=100"}},
          {"liu13", {"integrator.method=liu13", "integrator.max_iterations=1000"}},
          {"quasi-newton", {"integrator.method=quasi-newton"}},
          {"quasi-newton, default tolerance", {"integrator={method=\"quasi-newton\"}"}}};
}

std::string grid_override(int cells) { return fmt::format("cloth.mesh={{grid=[{0},{0}]}}", cells); }

/// Returns the allocated heap memory [bytes].
double heap() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// The measurement of one method on one grid.
class MethodOnGrid {
 public:
  MethodOnGrid(const Variant& variant, int cells, const State& start, double start_time) {
    point_.method = variant.name;
    point_.cells = cells;
    point_.study_case = {variant.name, scene_file, {grid_override(cells)}, warm_up + timed_steps};
    point_.study_case.overrides.insert(point_.study_case.overrides.end(), variant.overrides.begin(),
                                       variant.overrides.end());
    if (point_.method == "semi-implicit") choose_safe_step();
    settings_ = point_.study_case.load().simulation;
    point_.vertices = settings_.cloth.vertex_count();
    point_.step = settings_.step;
    start_ = start;
    start_.step = std::llround(start_time / point_.step);
  }

  /// Measures iterations, memory and time shares in an untimed run.
  void measure_once() {
    const double before = heap();
    simulation_ = std::make_unique<Simulation>(settings_);
    point_.iterations = run(*simulation_) / timed_steps;
    point_.memory = heap() - before;
    find_shares();
  }

  void measure() {
    double begin = thread_seconds();
    simulation_ = std::make_unique<Simulation>(settings_);
    setup_.push_back(1e6 * (thread_seconds() - begin));
    if (point_.method != "semi-implicit") {
      const System system = make_system(settings_);
      begin = thread_seconds();
      const ConstantFactor factor(system, system.step, Precision::automatic);
      factor_.push_back(1e6 * (thread_seconds() - begin));
    }
    simulation_->restore(start_);
    simulation_->step();  // warms the caches
    begin = thread_seconds();
    run(*simulation_);
    time_.push_back(1e6 * (thread_seconds() - begin) / timed_steps);
    simulation_.reset();
  }

  [[nodiscard]] bool done(RunCount runs) const { return is_enough(time_, runs); }

  ScalingPoint finish() {
    point_.time = median_interval(time_);
    point_.setup = median_interval(setup_);
    if (!factor_.empty()) point_.factor = median_interval(factor_).median;
    return std::move(point_);
  }

 private:
  /// Sets the largest stable step, with some margin; semi-implicit Euler is unstable with the scene's own step.
  void choose_safe_step() {
    StudyCase bold = point_.study_case;
    bold.overrides.emplace_back("integrator.allow_unstable=true");
    const SimulationSettings settings = bold.load().simulation;
    const double step = of_safe_step * safe_step(make_system(settings));
    point_.study_case.overrides.push_back("time.step=" + fmt::format("{:.3g}", step));
  }

  /// Takes the timed steps; returns the sum of their iterations.
  double run(Simulation& simulation) {
    simulation.restore(start_);
    double iterations = 0;
    run_steps(simulation, start_.step + timed_steps, {},
              [&](const StepReport& report) { iterations += report.iterations; });
    return iterations;
  }

  void find_shares() {
    Simulation simulation(settings_, Timing::effects);
    KernelClock clock;
    run(simulation);
    const auto effects = [&] {
      const std::vector<double>& all = simulation.effect_seconds();
      return std::accumulate(all.begin(), all.end(), 0.0);
    };
    const double effects_before = effects();
    clock.reset();
    const auto begin = std::chrono::steady_clock::now();
    run(simulation);
    const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    TimeShares& s = point_.shares;
    s.local = clock.seconds(KernelPart::local) / whole;
    s.assembly = clock.seconds(KernelPart::assembly) / whole;
    s.product = clock.seconds(KernelPart::product) / whole;
    s.global = clock.seconds(KernelPart::global) / whole;
    s.vectors = clock.seconds(KernelPart::vectors) / whole;
    s.contact = (effects() - effects_before) / whole;
    s.rest = std::max(0.0, 1 - s.local - s.assembly - s.product - s.global - s.vectors - s.contact);
  }

  ScalingPoint point_;
  SimulationSettings settings_;
  State start_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<double> time_, setup_, factor_;
};

/// Returns a state in contact with the sphere, by quasi-Newton.
State start_on(int cells, double& time) {
  const StudyCase study_case{"", scene_file, {grid_override(cells), "integrator.method=quasi-newton"}, warm_up};
  Simulation simulation(study_case.load().simulation);
  run_steps(simulation, warm_up, {});
  time = simulation.time();
  return simulation.state();
}

bool measure_grid(int cells, const std::stop_token& stop, Progress& progress, ScalingStudy& study) {
  std::vector<std::unique_ptr<MethodOnGrid>> methods;
  try {
    double time = 0;
    const State start = start_on(cells, time);
    for (const Variant& variant : variants()) {
      try {
        auto one = std::make_unique<MethodOnGrid>(variant, cells, start, time);
        one->measure_once();
        methods.push_back(std::move(one));
      } catch (const UsageError& error) {
        study.notes.push_back(fmt::format("{}, {}×{}: {}", variant.name, cells, cells, error.what()));
      }
      if (stop.stop_requested()) return false;
    }
  } catch (const UsageError& error) {
    study.notes.push_back(fmt::format("{}×{}: {}", cells, cells, error.what()));
  }
  ++progress.done;
  for (int run = 0; run < runs_at_most(study.options.runs); ++run) {
    for (const auto& one : methods) {
      if (stop.stop_requested()) return false;
      if (!one->done(study.options.runs)) one->measure();
    }
    ++progress.done;
  }
  for (const auto& one : methods) study.points.push_back(one->finish());
  return true;
}

}  // namespace

std::optional<ScalingStudy> study_scaling(const ScalingOptions& options, const std::stop_token& stop,
                                          Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const PinnedThread pinned;
  ScalingStudy study;
  study.options = options;
  progress.begin("measuring grids", "runs",
                 static_cast<std::int64_t>(options.grids.size()) * (runs_at_most(options.runs) + 1));
  for (const int cells : options.grids) {
    if (!measure_grid(cells, stop, progress, study)) return std::nullopt;
  }
  const auto order = [](const ScalingPoint& p) {
    const std::vector<Variant> all = variants();
    return std::find_if(all.begin(), all.end(), [&](const Variant& v) { return v.name == p.method; }) - all.begin();
  };
  std::stable_sort(study.points.begin(), study.points.end(),
                   [&](const ScalingPoint& a, const ScalingPoint& b) { return order(a) < order(b); });
  study.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return study;
}

namespace {

std::string percent(double share) { return share > 0 ? fmt::format("{:.1f}", 100 * share) : "–"; }
std::string exponent(double value) { return std::isfinite(value) ? fmt::format("{:.2f}", value) : "–"; }

double per_iteration(const ScalingPoint& p) { return p.time.median / std::max(1.0, p.iterations); }
double per_vertex(const ScalingPoint& p) { return p.time.median / p.vertices; }

/// Returns the methods in the order of their points.
std::vector<std::string> methods_of(const ScalingStudy& study) {
  std::vector<std::string> names;
  for (const ScalingPoint& p : study.points) {
    if (names.empty() || names.back() != p.method) names.push_back(p.method);
  }
  return names;
}

template <class Value>
double growth(const ScalingStudy& study, const std::string& method, Value value) {
  std::vector<std::array<double, 2>> points;
  for (const ScalingPoint& p : study.points) {
    if (p.method == method) points.push_back({p.vertices, value(p)});
  }
  return fitted_exponent(points);
}

struct Growth {
  std::string method;
  double step, iterations, iteration, factor, memory;
};

std::vector<Growth> growths(const ScalingStudy& study) {
  std::vector<Growth> all;
  for (const std::string& method : methods_of(study)) {
    all.push_back({method, growth(study, method, [](const ScalingPoint& p) { return p.time.median; }),
                   growth(study, method, [](const ScalingPoint& p) { return p.iterations; }),
                   growth(study, method, per_iteration),
                   growth(study, method, [](const ScalingPoint& p) { return p.factor; }),
                   growth(study, method, [](const ScalingPoint& p) { return p.memory; })});
  }
  return all;
}

/// Returns the answer in one sentence: the methods whose time grows least and most.
std::string headline(std::vector<Growth> all) {
  std::erase_if(all, [](const Growth& g) { return !std::isfinite(g.step); });
  if (all.empty()) return "How time and memory grow with the cloth";
  const auto [least, most] = std::ranges::minmax_element(all, {}, &Growth::step);
  const std::string first =
      fmt::format("Time per step grows as n to the power {} ({})", exponent(least->step), least->method);
  return all.size() == 1 ? first : first + fmt::format(" to {} ({})", exponent(most->step), most->method);
}

ResultTable time_table(const ScalingStudy& study) {
  ResultTable table{
      "scaling-times",
      "Time and memory",
      {"method", "grid", "vertices", "h [s]", "iterations", "µs per step", "from", "to", "runs", "µs per iteration",
       "set-up [µs]", "of which factor", "memory [MB]"},
      {},
      {"Semi-implicit steps are just below the stability limit; set-up is then the search for that limit."}};
  for (const ScalingPoint& p : study.points) {
    table.rows.push_back({p.method, fmt::format("{0}×{0}", p.cells), fmt::format("{}", p.vertices),
                          fmt::format("{:g}", p.step), p.iterations > 0 ? fmt::format("{:.1f}", p.iterations) : "–",
                          three_digits(p.time.median), three_digits(p.time.lower), three_digits(p.time.upper),
                          fmt::format("{}", p.time.count), three_digits(per_iteration(p)), three_digits(p.setup.median),
                          p.factor > 0 ? three_digits(p.factor) : "–", three_digits(1e-6 * p.memory)});
  }
  return table;
}

ResultTable growth_table(const ScalingStudy& study) {
  ResultTable table{"scaling-growth",
                    "Growth: p in (number of vertices)ᵖ, fitted to all grids",
                    {"method", "time per step", "iterations", "time per iteration", "factor", "memory"},
                    {},
                    {}};
  for (const Growth& g : growths(study)) {
    table.rows.push_back({g.method, exponent(g.step), exponent(g.iterations), exponent(g.iteration), exponent(g.factor),
                          exponent(g.memory)});
  }
  return table;
}

ResultTable share_table(const ScalingStudy& study) {
  ResultTable table{"scaling-shares",
                    "Where step time goes [%]",
                    {"method", "grid", "local", "assembly", "products", "global", "vectors", "contact", "rest"},
                    {},
                    {"Local: the springs' energies and forces. Assembly: the blocks of Newton's matrix. Products: with "
                     "that matrix, in conjugate gradients. Global: solves with the constant factor, also Newton's "
                     "preconditioner. Vectors: their sums and products. Contact: the sphere, and gravity.",
                     "With cholesky, the rest is Newton's matrix, its factorisation and the solve. Measured in a "
                     "separate run with a clock around every hot loop."}};
  for (const ScalingPoint& p : study.points) {
    const TimeShares& s = p.shares;
    table.rows.push_back({p.method, fmt::format("{0}×{0}", p.cells), percent(s.local), percent(s.assembly),
                          percent(s.product), percent(s.global), percent(s.vectors), percent(s.contact),
                          percent(s.rest)});
  }
  return table;
}

template <class Value>
NamedChart chart_of(const ScalingStudy& study, const std::string& name, const std::string& title,
                    const std::string& quantity, const std::string& unit, Value value) {
  html::Chart chart{title, "vertices", quantity + " [" + unit + "]", html::Scale::logarithmic, html::Scale::logarithmic,
                    {},    {}};
  for (const std::string& method : methods_of(study)) {
    html::ChartSeries series = method_series(method);
    for (const ScalingPoint& p : study.points) {
      if (p.method != method) continue;
      series.points.push_back({p.vertices,
                               value(p),
                               fmt::format("{0}×{0}: {1} {2}", p.cells, three_digits(value(p)), unit),
                               p.study_case.command(),
                               {}});
    }
    chart.series.push_back(std::move(series));
  }
  return {name, std::move(chart)};
}

/// Returns the most expensive part of a step.
std::string largest_share(const TimeShares& s) {
  const std::array<std::pair<const char*, double>, 7> parts{{{"the local step", s.local},
                                                             {"the assembly", s.assembly},
                                                             {"products with Newton's matrix", s.product},
                                                             {"the constant factor's triangles", s.global},
                                                             {"sums of vectors", s.vectors},
                                                             {"contact", s.contact},
                                                             {"the rest", s.rest}}};
  const auto* most =
      std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return fmt::format("{} ({:.0f} %)", most->first, 100 * most->second);
}

}  // namespace

StudyReport scaling_report(const ScalingStudy& study) {
  StudyReport report;
  report.kind = "drape study scaling";
  report.title = "How time and memory grow with the cloth";
  report.command = fmt::format("drape study scaling --grids {}", fmt::join(study.options.grids, ",")) +
                   runs_option(study.options.runs);
  report.introduction =
      "The homework's cloth on the sphere, k = 180 N/m, h = 0.02 s and ε = 1e-3 m, on ever finer grids. Every method "
      "starts from the same state, 0.5 s into the motion.";
  report.seconds = study.seconds;
  report.headline = headline(growths(study));
  for (const Growth& g : growths(study)) {
    const auto last = std::find_if(study.points.rbegin(), study.points.rend(),
                                   [&](const ScalingPoint& p) { return p.method == g.method; });
    report.findings.push_back(
        {html::Tone::neutral, "",
         fmt::format("{}: time per step grows as n to the power {}.", g.method, exponent(g.step)),
         fmt::format("On {0}×{0} cells a step takes {1} µs{2}, most of it {3}, and the simulation {4} MB.", last->cells,
                     three_digits(last->time.median),
                     last->iterations > 0 ? fmt::format(" in {:.1f} iterations", last->iterations) : "",
                     largest_share(last->shares), three_digits(1e-6 * last->memory))});
  }
  report.sections = {
      {"Growth",
       study.notes,
       {growth_table(study), time_table(study)},
       {chart_of(study, "scaling-step", "Time per step against the number of vertices.", "time per step", "µs",
                 [](const ScalingPoint& p) { return p.time.median; }),
        chart_of(study, "scaling-vertex", "Time per step and vertex against the number of vertices.", "time per vertex",
                 "µs", per_vertex),
        chart_of(study, "scaling-iteration", "Time per iteration against the number of vertices.", "time per iteration",
                 "µs", per_iteration),
        chart_of(study, "scaling-memory", "Memory against the number of vertices.", "memory", "MB",
                 [](const ScalingPoint& p) { return 1e-6 * p.memory; })},
       {}},
      {"Where the time goes", {}, {share_table(study)}, {}, {}},
      {"How it was measured",
       {fmt::format("Five steps from the same state, as computing time of one thread that stays on one processor: "
                    "{}. The methods take turns on each grid. Every run sets "
                    "the simulation up anew and takes a step that is not timed. Memory is what the "
                    "heap has given to the simulation.",
                    describe_runs(study.options.runs))},
       {},
       {},
       {}}};
  return report;
}

}  // namespace drape
