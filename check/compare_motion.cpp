#include "check/compare_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "run/run_steps.hpp"

namespace drape {
namespace {

// Of energies that belong to the same bits: what is left is the order of a sum, if anybody changes that.
constexpr double energy_rounding = 1e-12;

/// Collects how far the steps of a window are from their golden places.
class Collector {
 public:
  Collector(WindowResult& result, double tolerance) : result_(result), tolerance_(tolerance) {}

  void add(std::int64_t step, bool same_bits, const Vertices& actual, const Vertices& golden) {
    Eigen::Index vertex = 0;
    const double distance = std::sqrt((actual - golden).rowwise().squaredNorm().maxCoeff(&vertex));
    if (same_bits) {
      result_.deviations.push_back(0);
      const double rounded_by = std::max(tolerance_, 10 * least_quantum) + 1e-15 * actual.cwiseAbs().maxCoeff();
      if (!(distance <= rounded_by)) {
        fail(fmt::format("the golden is damaged: at step {} its bits are those of the motion, its positions are {} off",
                         step, readable_length(distance)));
      }
      return;
    }
    const Deviation deviation{.step = step, .vertex = static_cast<int>(vertex), .distance = distance};
    result_.deviations.push_back(distance);
    if (!result_.largest || distance > result_.largest->distance) result_.largest = deviation;
    const bool within = tolerance_ > 0 && distance <= tolerance_;
    if (!within && !result_.first) result_.first = deviation;
    result_.verdict = std::max(result_.verdict, within ? MotionVerdict::within_tolerance : MotionVerdict::changed);
  }

  /// The state that a window begins with. A velocity counts as the way it leads within some time.
  void add_start(const State& actual, const State& golden, double seconds) {
    const bool same_bits = state_bits(actual) == state_bits(golden);
    add(actual.step, same_bits, actual.x, golden.x);
    if (same_bits) return;
    Eigen::Index vertex = 0;
    const double speed = std::sqrt((actual.v - golden.v).rowwise().squaredNorm().maxCoeff(&vertex));
    if (speed == 0 || (tolerance_ > 0 && speed * seconds <= tolerance_)) return;
    fail(fmt::format("the velocity at step {} changed by {:.3g} m/s at vertex {}", actual.step, speed, vertex));
  }

  void add_energies(std::int64_t step, bool same_bits, const Energies& actual, const Energies& golden) {
    const double scale = std::max({std::abs(golden.kinetic), std::abs(golden.gravity), std::abs(golden.elastic)});
    if (!same_bits || !result_.problem.empty()) return;
    const double difference =
        std::max({std::abs(actual.kinetic - golden.kinetic), std::abs(actual.gravity - golden.gravity),
                  std::abs(actual.elastic - golden.elastic)});
    if (difference <= energy_rounding * scale) return;
    fail(fmt::format("the energies of step {} changed, the motion did not: {:.9g} J in total, {:.9g} J in the golden",
                     step, actual.total(), golden.total()));
  }

  /// Only the first problem is told.
  void fail(std::string problem) {
    if (result_.problem.empty()) result_.problem = std::move(problem);
    result_.verdict = MotionVerdict::changed;
  }

 private:
  WindowResult& result_;
  double tolerance_;
};

std::int64_t last_step(const GoldenWindow& window) {
  return window.start.step + static_cast<std::int64_t>(window.steps.size());
}

WindowResult empty_result(const GoldenWindow& window) {
  WindowResult result;
  result.frame = window.frame;
  result.first_step = window.start.step;
  result.last_step = last_step(window);
  return result;
}

/// How long the motion of a window takes, and no less than a step [s].
double seconds(const GoldenWindow& window, double step) {
  return step * static_cast<double>(std::max<std::size_t>(window.steps.size(), 1));
}

WindowResult compare_window(Simulation& simulation, const State& initial, const GoldenWindow& window,
                            double tolerance) {
  WindowResult result = empty_result(window);
  Collector collector(result, tolerance);
  const State& start = window.start.step == 0 ? initial : window.start;
  collector.add_start(start, window.start, seconds(window, simulation.settings().step));
  simulation.restore(start);
  try {
    auto golden = window.steps.begin();
    run_steps(simulation, result.last_step, {}, [&](const StepReport&) {
      const State& state = simulation.state();
      const bool same = state_bits(state) == golden->bits;
      collector.add(state.step, same, state.x, golden->x);
      collector.add_energies(state.step, same, simulation.energies(), golden->energies);
      ++golden;
    });
  } catch (const DivergedError& diverged) {
    collector.fail(diverged.what());
  }
  return result;
}

}  // namespace

std::vector<WindowResult> compare_windows(const SimulationSettings& settings, const std::vector<GoldenWindow>& windows,
                                          double tolerance, std::size_t threads, const std::stop_token& stop,
                                          const std::function<void()>& done) {
  std::vector<WindowResult> results(windows.size());
  std::vector<std::unique_ptr<Simulation>> simulations(threads);
  std::vector<State> initial(threads);
  for_each_in_parallel(threads, windows.size(), stop, [&](std::size_t worker, std::size_t i) {
    if (!simulations[worker]) {
      simulations[worker] = std::make_unique<Simulation>(settings);
      initial[worker] = simulations[worker]->state();
    }
    results[i] = compare_window(*simulations[worker], initial[worker], windows[i], tolerance);
    done();
  });
  return results;
}

std::vector<WindowResult> compare_starts(const std::vector<GoldenWindow>& golden,
                                         const std::vector<GoldenWindow>& actual, double step, double tolerance) {
  std::vector<WindowResult> results;
  for (std::size_t i = 0; i < std::min(golden.size(), actual.size()); ++i) {
    WindowResult& result = results.emplace_back(empty_result(golden[i]));
    result.last_step = result.first_step;
    Collector(result, tolerance).add_start(actual[i].start, golden[i].start, step);
  }
  return results;
}

std::vector<Vertices> rerun_window(const SimulationSettings& settings, const GoldenWindow& window) {
  Simulation simulation(settings);
  simulation.restore(window.start);
  std::vector<Vertices> positions{window.start.x};
  try {
    run_steps(simulation, last_step(window), {}, [&](const StepReport&) { positions.push_back(simulation.state().x); });
  } catch (const DivergedError&) {
    // What there is up to here is shown.
  }
  return positions;
}

std::string describe_motion(const std::vector<WindowResult>& windows) {
  const WindowResult* first = nullptr;
  const Deviation* largest = nullptr;
  for (const WindowResult& window : windows) {
    if (window.verdict != MotionVerdict::changed) continue;
    if (first == nullptr) first = &window;
    if (window.largest && (largest == nullptr || window.largest->distance > largest->distance)) {
      largest = &*window.largest;
    }
  }
  if (first == nullptr) return {};
  if (!first->first || largest == nullptr) return first->problem;
  std::string text = fmt::format("the motion changed at step {} by {} at vertex {}", first->first->step,
                                 readable_length(first->first->distance), first->first->vertex);
  if (largest->step != first->first->step) {
    text += fmt::format(", and by up to {} at vertex {} at step {}", readable_length(largest->distance),
                        largest->vertex, largest->step);
  }
  if (!first->problem.empty()) text += "; " + first->problem;
  return text;
}

}  // namespace drape
