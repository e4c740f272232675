#include "check/step_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <vector>

#include "drape/sim/simulation.hpp"

namespace drape {
namespace {

constexpr double shortest_run = 0.03;  // duration of one measurement [s]
constexpr double calibration_time = 0.01;
constexpr std::size_t turns = 7;  // the result is their median
constexpr int attempts = 6;       // measurements before a time counts as too long

/// Returns the CPU time of this thread [s].
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A loop over springs between points, typical of a simulation's work. It must not change: goldens hold ratios to it.
class Calibration {
 public:
  Calibration() {
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t k = 0; k < 3; ++k) x_[i][k] = std::sin(static_cast<double>(3 * i + k));
    }
  }

  /// Returns the time of a pass over all springs [s].
  double seconds() {
    const double begin = thread_seconds();
    double now = begin;
    std::int64_t passes = 0;
    for (; now - begin < calibration_time; now = thread_seconds(), ++passes) pass();
    return (now - begin) / static_cast<double>(passes);
  }

 private:
  static constexpr std::size_t points = 4000, reach = 37;

  void pass() {
    constexpr double stiffness = 1e-3, length = 1;
    for (std::size_t i = 0; i < points; ++i) {
      std::array<double, 3>&a = x_[i], &b = x_[(i + reach) % points];
      const std::array<double, 3> d{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
      const double norm = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) + length / 2;
      const double pull = stiffness * (norm - length) / norm;
      for (std::size_t k = 0; k < 3; ++k) {
        a[k] += pull * d[k];
        b[k] -= pull * d[k];
      }
    }
  }

  std::vector<std::array<double, 3>> x_ = std::vector<std::array<double, 3>>(points);
};

/// Runs the first steps; with `steps` = 0, until the time is measurable.
/// @returns their number
std::int64_t run(const Scene& scene, std::int64_t steps, const std::stop_token& stop) {
  const double begin = thread_seconds();
  Simulation simulation(scene.simulation);
  const std::int64_t all = scene.step_count();
  std::int64_t done = 0;
  while (done < all && !stop.stop_requested() && (steps > 0 ? done < steps : thread_seconds() - begin < shortest_run)) {
    simulation.step();
    ++done;
  }
  return done;
}

/// Returns the time of a run, repeated if short [s].
double run_seconds(const Scene& scene, std::int64_t steps, const std::stop_token& stop) {
  const double begin = thread_seconds();
  double taken = 0;
  int runs = 0;
  for (; taken < shortest_run && !stop.stop_requested(); ++runs) {
    run(scene, steps, stop);
    taken = thread_seconds() - begin;
  }
  return taken / std::max(1, runs);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::optional<GoldenTime> measure_step_time(const Scene& scene, std::int64_t steps, const std::stop_token& stop) {
  Calibration calibration;
  GoldenTime time;
  time.steps = run(scene, steps, stop);  // also warms the caches
  std::vector<double> ratios;
  double before = calibration.seconds();
  for (std::size_t turn = 0; turn < turns && time.steps > 0; ++turn) {
    const double seconds = run_seconds(scene, time.steps, stop);
    if (stop.stop_requested()) return std::nullopt;
    const double after = calibration.seconds();
    ratios.push_back(2 * seconds / (before + after));
    before = after;
  }
  if (stop.stop_requested()) return std::nullopt;
  time.ratio = ratios.empty() ? 0 : median(ratios);
  return time;
}

std::optional<SlowSteps> time_mismatch(const Scene& scene, const GoldenTime& golden, double limit,
                                       const std::stop_token& stop) {
  if (golden.steps == 0) return std::nullopt;
  double least = INFINITY;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::optional<GoldenTime> now = measure_step_time(scene, golden.steps, stop);
    if (!now) return std::nullopt;
    least = std::min(least, now->ratio / golden.ratio);
    if (least <= limit) return std::nullopt;
  }
  return SlowSteps{golden.steps, least};
}

}  // namespace drape
