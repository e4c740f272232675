#include "study/energy_over_time.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "drape/scene/scene.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/simulation.hpp"
#include "reports/chart.hpp"
#include "run/run_scene.hpp"

namespace drape {
namespace {

constexpr double duration = 8, sample_interval = 0.1;  // [s]

SimulationSettings swinging_cloth(StepMethod method, double step) {
  const Mesh mesh = make_grid(20, 20);
  SimulationSettings settings;
  settings.cloth = make_cloth(mesh, mesh, 1, 180, {0, 20});
  settings.step = step;
  settings.integrator.method = method.method;
  settings.integrator.scheme = method.scheme;
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = 1e-6;
  settings.integrator.max_iterations = 5000;
  settings.effects.add(Gravity{});
  return settings;
}

/// Observer that stores the energy every `every` steps.
class EnergySamples final : public StepObserver {
 public:
  EnergySamples(std::int64_t every, EnergyCurve& curve) : every_(every), curve_(curve) {}

  void begin(const Simulation& simulation) override {
    first_ = simulation.energies().total();
    keep(simulation);
  }
  void after_step(const Simulation& simulation, const StepReport&, double) override { keep(simulation); }

  /// Divides the curve by the largest drop of gravity's energy.
  void finish() {
    for (double& energy : curve_.energies) energy /= moved_;
  }

 private:
  void keep(const Simulation& simulation) {
    const Energies now = simulation.energies();
    moved_ = std::max(moved_, -now.gravity);  // it is 0 at the start
    if (simulation.state().step % every_ != 0) return;
    curve_.times.push_back(simulation.time());
    curve_.energies.push_back(now.total() - first_);
  }

  std::int64_t every_;
  EnergyCurve& curve_;
  double first_ = 0, moved_ = 0;
};

std::string name_of(const EnergyCurve& curve) {
  return fmt::format("{}, h = {:g} s", step_method_name(curve.method), curve.step);
}

}  // namespace

std::vector<EnergyCurve> energy_curves() {
  constexpr StepMethod sdirk2(Method::quasi_newton, TimeScheme::sdirk2);
  return {{.method = Method::verlet, .step = 0.001},
          {.method = sdirk2, .step = 0.0025},
          {.method = sdirk2, .step = 0.02},
          {.method = Method::quasi_newton, .step = 0.0025},
          {.method = Method::quasi_newton, .step = 0.02}};
}

std::int64_t step_count(const EnergyCurve& curve) { return std::llround(duration / curve.step); }

void measure_energy(EnergyCurve& curve, const std::stop_token& stop) {
  Simulation simulation(swinging_cloth(curve.method, curve.step));
  EnergySamples samples(std::llround(sample_interval / curve.step), curve);
  StepObserver* const observer = &samples;
  run_steps(simulation, step_count(curve), {&observer, 1}, stop);
  samples.finish();
}

NamedChart energy_chart(const std::vector<EnergyCurve>& curves) {
  html::Chart chart{"Energy of a cloth that swings without damping, relative to the energy exchanged with gravity.",
                    "time [s]",
                    "energy gained, relative to energy exchanged",
                    html::Scale::linear,
                    html::Scale::linear,
                    {},
                    {}};
  for (const EnergyCurve& curve : curves) {
    html::ChartSeries series = method_series(step_method_name(curve.method));
    series.name = name_of(curve);
    series.markers = false;
    // Colours show the scheme here; the long step is dashed.
    if (curve.method.scheme == TimeScheme::sdirk2) series.style = 5;
    series.other = curve.step > 0.01;
    for (std::size_t i = 0; i < curve.times.size(); ++i) {
      series.points.push_back({curve.times[i],
                               curve.energies[i],
                               fmt::format("{:.1f} s: {:.2g}", curve.times[i], curve.energies[i]),
                               {},
                               {}});
    }
    chart.series.push_back(std::move(series));
  }
  return {"energy-over-time", std::move(chart)};
}

std::string describe_energies(const std::vector<EnergyCurve>& curves) {
  std::string text = "After eight seconds ";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double end = curves[i].energies.back();
    text += fmt::format("{}{} has {} {:.2g} % of the energy exchanged with gravity", i == 0 ? "" : ", ",
                        name_of(curves[i]), end < 0 ? "lost" : "gained", 100 * std::abs(end));
  }
  return text + ".";
}

}  // namespace drape
