#include "run/run_steps.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>

#include "core/error.hpp"
#include "core/text.hpp"
#include "sim/make_system.hpp"

namespace drape {
namespace {

class Watch final : public StepObserver {
 public:
  explicit Watch(const std::function<void(const StepReport&)>& after_step) : after_step_(after_step) {}
  void after_step(const Simulation&, const StepReport& report, double) override { after_step_(report); }

 private:
  const std::function<void(const StepReport&)>& after_step_;
};

/// Replays the earlier steps to the observers.
void replay(const ResumePoint& from, double h, std::span<StepObserver* const> observers) {
  if (from.checkpoint.state.step == 0) return;  // a new run
  for (std::int64_t step = 0; step <= from.checkpoint.state.step; ++step) {
    const StepRow& row = from.row(step);
    const double seconds =
        step == 0 ? 0 : 1e-6 * static_cast<double>(from.microseconds[static_cast<std::size_t>(step - 1)]);
    for (StepObserver* observer : observers) observer->replay(row, static_cast<double>(step) * h, seconds);
  }
}

}  // namespace

void require_whole(const ResumePoint& from, const Simulation& simulation) {
  const Simulation::Checkpoint& kept = from.checkpoint;
  const System system = make_system(simulation.settings());
  Restraint expected;
  for (const auto& filter : system.filters) {
    const Restraint* const restraint = filter->restraint();
    if (restraint != nullptr && kept.state.step > 0) expected = *restraint;
  }
  const Restraint& restraint = kept.state.restraint;
  if (kept.books.has_value() == simulation.checkpoint().books.has_value() &&
      restraint.tensions.size() == expected.tensions.size() &&
      restraint.acceleration.rows() == expected.acceleration.rows()) {
    return;
  }
  throw UsageError(fmt::format("{}: cannot be resumed, because its checkpoint does not have all parts: simulate again",
                               shown(from.partial->file())));
}

Stop make_stop(const std::stop_token& stop) {
  return Stop([stop] { return stop.stop_requested(); });
}

void run_steps(Simulation& simulation, std::int64_t steps, std::span<StepObserver* const> observers,
               const std::stop_token& stop, const ResumePoint* from) {
  using Clock = std::chrono::steady_clock;
  if (from != nullptr) simulation.restore(from->checkpoint);
  for (StepObserver* observer : observers) observer->begin(simulation);
  if (from != nullptr) replay(*from, simulation.settings().step, observers);
  while (simulation.state().step < steps && !stop.stop_requested()) {
    const auto begin = Clock::now();
    StepReport report;
    try {
      report = simulation.step();
    } catch (const Interrupted&) {
      return;
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    try {
      for (StepObserver* observer : observers) observer->after_step(simulation, report, seconds);
    } catch (const Interrupted&) {
      return simulation.undo_step();
    }
  }
}

void run_steps(Simulation& simulation, std::int64_t steps, const std::stop_token& stop,
               const std::function<void(const StepReport&)>& after_step) {
  if (!after_step) return run_steps(simulation, steps, std::span<StepObserver* const>(), stop);
  Watch watch(after_step);
  run_steps(simulation, steps, std::array<StepObserver*, 1>{&watch}, stop);
}

void run_on(const SimulationSettings& settings, const State& state, std::int64_t steps,
            const std::vector<StepObserver*>& observers, const std::stop_token& stop) {
  if (state.step >= steps) return;
  try {
    Simulation simulation(settings, Timing::none, make_stop(stop));
    simulation.restore(state);
    run_steps(simulation, steps, observers, stop);
  } catch (const DivergedError&) {
    // Show the steps before the divergence.
  } catch (const Interrupted&) {  // during setup
  }
}

void StepCounter::after_step(const Simulation& simulation, const StepReport&, double) {
  progress_.done = simulation.state().step;
}

}  // namespace drape
