#include "run/progress.hpp"

#include <fmt/format.h>

#include "drape/scene/scene.hpp"

namespace drape {
namespace {

/// The main cost of a run and its remedy.
struct Reason {
  std::string why, faster;
};

std::string about(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.0f} h", seconds / 3600);
}

Reason of_iterations(double iterations, const SimulationSettings& settings) {
  constexpr double coarse = 1e-4;  // share of the cloth's size: a hundred times the default tolerance
  const IntegratorSettings& integrator = settings.integrator;
  const std::string why = fmt::format("each takes {:.0f} iterations", iterations);
  if (integrator.method != Method::quasi_newton) return {why, "method = \"quasi-newton\""};
  if (integrator.stop || integrator.tolerance) return {why, "a larger [integrator] tolerance"};
  return {why, fmt::format("[integrator] stop = \"error\" with tolerance = {:.1g}", coarse * size_of(settings.cloth))};
}

Reason reason(const Pace& pace, const SimulationSettings& settings) {
  constexpr double many_iterations = 50, several_substeps = 1.5;
  const auto steps = static_cast<double>(pace.steps);
  const IntegratorSettings& integrator = settings.integrator;
  if (pace.drawn && pace.simulated < 0.5 * pace.seconds) {
    return {"most of it is drawing", "a smaller [video] size, or fewer frames"};
  }
  if (settings.accuracy && pace.substeps > several_substeps * steps) {
    return {fmt::format("[time] accuracy cuts each into {:.0f} substeps", pace.substeps / steps),
            "a larger [time] accuracy"};
  }
  if (pace.iterations > many_iterations * steps) return of_iterations(pace.iterations / steps, settings);
  const std::string why =
      fmt::format("each takes {:.3g} ms for {} vertices", 1e3 * pace.simulated / steps, settings.cloth.vertex_count());
  if (is_explicit(integrator.method)) {
    return {why, "a longer [time] step with an implicit method, such as method = \"quasi-newton\""};
  }
  return {why, "a longer [time] step, or a coarser mesh"};
}

}  // namespace

std::string describe_pace(const Pace& pace, const SimulationSettings& settings) {
  const Reason found = reason(pace, settings);
  return fmt::format("{} steps will take about {}: {}; faster would be {}", pace.steps + pace.left, about(pace.whole()),
                     found.why, found.faster);
}

void SlowRunWarning::begin(const Simulation& simulation) {
  pace_.left = steps_ - simulation.state().step;
  begin_ = Clock::now();
}

void SlowRunWarning::after_step(const Simulation& simulation, const StepReport& report, double seconds) {
  ++pace_.steps;
  --pace_.left;
  pace_.simulated += seconds;
  pace_.iterations += report.iterations;
  pace_.substeps += static_cast<double>(report.substeps);
  if (told_) return;
  pace_.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  if (pace_.seconds < next_look_) return;
  next_look_ = 2 * pace_.seconds;  // a run may become slow later
  if (pace_.whole() < limits_.long_run) return;
  told_ = true;
  tell_(describe_pace(pace_, simulation.settings()));
}

}  // namespace drape
