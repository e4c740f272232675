// Times steps of the three methods on a moving cloth, drape's beside the textbook's, in one process.
// Flags are Google Benchmark's, for example --benchmark_filter=liu13 or --benchmark_out=steps.json.

#include <benchmark/benchmark.h>
#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/moving_cloth.hpp"
#include "bench/ratio_table.hpp"
#include "bench/textbook.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/simulation.hpp"

namespace drape {
namespace {

/// Work of one row: `batch` steps of semi-implicit Euler, or one step of `batch` iterations of another method.
/// Batches are sized to last a few milliseconds at least.
struct Case {
  std::string name;
  Method method;
  int cells;
  double step;  ///< h [s]
  int batch;
};

const std::vector<Case>& cases() {
  // Semi-implicit Euler is stable only if the step shrinks with the cells.
  static const std::vector<Case> all{
      {"semi_implicit_step/20", Method::semi_implicit, 20, 0.001, 500},
      {"semi_implicit_step/100", Method::semi_implicit, 100, 0.0002, 20},
      {"liu13_iteration/20", Method::liu13, 20, 0.02, 100},
      {"liu13_iteration/100", Method::liu13, 100, 0.02, 20},
      {"liu13_iteration/300", Method::liu13, 300, 0.02, 5},
      {"newton_iteration/20", Method::implicit, 20, 0.02, 4},
      {"newton_iteration/100", Method::implicit, 100, 0.02, 2},
  };
  return all;
}

/// Damping of the homework's scene for semi-implicit Euler: fraction of a velocity left after one second.
constexpr double damping = 0.2;

/// Tolerance that no iteration meets, so that a step does its whole batch.
constexpr double never = 0;

/// @param step does one step and returns its iterations; semi-implicit Euler has none, so its batch counts steps
template <class Step>
std::function<int()> make_run(const Case& c, Step step) {
  if (c.method != Method::semi_implicit) return step;
  return [step, batch = c.batch] {
    for (int i = 0; i < batch; ++i) step();
    return batch;
  };
}

Subject make_textbook(const Case& c) {
  const Cloth cloth = make_moving_cloth(c.cells);
  textbook::Settings settings;
  settings.step = c.step;
  settings.tolerance = never;
  settings.max_iterations = c.batch;
  if (c.method == Method::semi_implicit) settings.damping = damping;
  const auto make = c.method == Method::semi_implicit ? textbook::make_semi_implicit
                    : c.method == Method::implicit    ? textbook::make_newton
                                                      : textbook::make_liu13;
  const std::shared_ptr<textbook::Stepper> stepper = make(cloth, settings);
  return {.restore =
              [stepper, x = cloth.positions, v = cloth.velocities] {
                stepper->positions = x;
                stepper->velocities = v;
              },
          .run = make_run(c, [stepper] {
            stepper->step();
            return stepper->iterations;
          })};
}

Subject make_drape(const Case& c) {
  SimulationSettings settings;
  settings.cloth = make_moving_cloth(c.cells);
  settings.step = c.step;
  settings.integrator.method = c.method;
  settings.integrator.tolerance = never;
  settings.integrator.max_iterations = c.batch;
  settings.effects = {Gravity{}};
  if (c.method == Method::semi_implicit) settings.effects.add(Damping{.factor = damping});
  const auto simulation = std::make_shared<Simulation>(std::move(settings));
  return {.restore = [simulation, start = simulation->state()] { simulation->restore(start); },
          .run = make_run(c, [simulation] { return simulation->step().iterations; })};
}

}  // namespace
}  // namespace drape

int main(int argc, char** argv) {
  std::vector<std::string> names;
  for (const drape::Case& c : drape::cases()) {
    drape::register_subject(c.name, "drape", c.batch, [c] { return drape::make_drape(c); });
    drape::register_subject(c.name, "textbook", c.batch, [c] { return drape::make_textbook(c); });
    names.push_back(c.name);
  }
  for (std::string& name : drape::register_equal_accuracy()) names.push_back(std::move(name));

  std::vector<std::string> schemes = drape::register_time_schemes();
  std::vector<std::string> peers = drape::register_peers();
  std::vector<std::string> effects = drape::register_effect_costs();
  std::vector<std::string> drawing = drape::register_drawing();
  for (std::string& name : drawing) effects.push_back(std::move(name));
  std::vector<std::string> encoding = drape::register_encoding();
  std::vector<std::string> factoring = drape::register_factoring();
  std::vector<std::string> supernodal = drape::register_supernodal_factoring();

  // Defaults come first, so that the caller's flags override them.
  std::vector<std::string> defaults{"--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=11"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& flag : defaults) arguments.push_back(flag.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;

  drape::RatioReporter reporter({{.first = "drape", .second = "textbook", .cases = std::move(names)},
                                 {.first = "second order", .second = "first order", .cases = std::move(schemes)},
                                 {.first = "drape", .second = "xpbd", .cases = std::move(peers)},
                                 {.first = "with", .second = "without", .cases = std::move(effects)},
                                 {.first = "drape", .second = "ffmpeg", .cases = std::move(encoding)},
                                 {.first = "fronts", .second = "cholmod", .cases = std::move(factoring)},
                                 {.first = "fronts", .second = "supernodal", .cases = std::move(supernodal)}});
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
}
