#include "study/scaling.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <numeric>
#include <utility>

#include "run/run_steps.hpp"
#include "sim/linear/constant_factor.hpp"
#include "sim/make_system.hpp"
#include "sim/stability.hpp"
#include "study/kernel_clock.hpp"

namespace drape {
namespace {

constexpr const char* scene_file = "scenes/homework/5.toml";
constexpr int smallest_grid = 10;
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
          {"quasi-newton", {"integrator.method=quasi-newton"}}};
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
    point_.what = {variant.name, scene_file, {grid_override(cells)}, warm_up + timed_steps};
    point_.what.overrides.insert(point_.what.overrides.end(), variant.overrides.begin(), variant.overrides.end());
    if (point_.method == "semi-implicit") choose_safe_step();
    settings_ = point_.what.load().simulation;
    point_.vertices = settings_.cloth.vertex_count();
    point_.step = settings_.step;
    start_ = start;
    start_.step = std::llround(start_time / point_.step);
  }

  /// Measures iterations, memory and time shares in an untimed run.
  void look() {
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
    StudyCase bold = point_.what;
    bold.overrides.emplace_back("integrator.allow_unstable=true");
    const SimulationSettings settings = bold.load().simulation;
    const double step = of_safe_step * safe_step(make_system(settings));
    point_.what.overrides.push_back("time.step=" + fmt::format("{:.3g}", step));
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
  const StudyCase what{"", scene_file, {grid_override(cells), "integrator.method=quasi-newton"}, warm_up};
  Simulation simulation(what.load().simulation);
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
        one->look();
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
  std::vector<int> grids;
  for (int cells = smallest_grid; cells <= options.largest; cells *= 2) grids.push_back(cells);
  progress.begin("measuring grids", "runs", static_cast<std::int64_t>(grids.size()) * (runs_at_most(options.runs) + 1));
  for (const int cells : grids) {
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

}  // namespace drape
