#include "audit/report/audit_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "audit/energy_rise.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "run/run_steps.hpp"
#include "sim/effects/strain_limit.hpp"
#include "sim/make_system.hpp"

namespace drape {
namespace {

/// Energies of the steps, for their largest rise.
class EnergyBook {
 public:
  explicit EnergyBook(double step) : step_(step) {}

  void add(const Energies& now) {
    if (totals_.empty()) first_ = now.total();
    totals_.push_back(now.total());
    available_ = std::max(available_, first_ - now.gravity);
  }

  [[nodiscard]] EnergyAudit judge() const {
    const audit::EnergyRise rise = audit::largest_rise(totals_);
    return {.not_judged = {},
            .rise = rise.rise,
            .of_available = available_ > 0 ? rise.rise / available_ : 0,
            .from = rise.from * step_,
            .to = rise.to * step_};
  }

 private:
  double step_;  // h [s]
  std::vector<double> totals_;
  double first_ = 0, available_ = 0;
};

/// Returns the reason why the energy of a scene may rise; empty if it can only decrease.
std::string cause_of_rises(const Scene& scene, const System& system) {
  if (is_explicit(scene.simulation.integrator.method)) return "the energy of an explicit method oscillates";
  if (!system.only_loses_energy()) return "something that moves, blows or attracts may do work on the cloth";
  return {};
}

audit::AuditedCloth audited_cloth(const Scene& scene, const System& system, const AuditOptions& options,
                                  bool imported) {
  const Cloth& cloth = scene.simulation.cloth;
  const Eigen::Vector3d gravity = imported ? Eigen::Vector3d(-Eigen::Vector3d::UnitZ()) : system.gravity;
  const bool known = !imported || options.held.has_value();  // pins of imported motions are unknown
  return {.rest = cloth.rest,
          .triangles = cloth.triangles,
          .held = {.known = known, .vertices = options.held.value_or(cloth.pins)},
          .down = gravity.isZero(0) ? gravity : Eigen::Vector3d(gravity.normalized())};
}

constexpr double usual_stretch = 1.1;  // limit for the edges of an imported motion

audit::AuditLimits limits_of(const Scene& scene, const AuditOptions& options, bool imported) {
  audit::AuditLimits limits{.depth = options.depth};
  if (imported) limits.stretch = usual_stretch;
  for (const Effect& effect : scene.simulation.effects) {
    const auto* limit = effect.as<StrainLimit>();
    if (limit != nullptr) limits.stretch = limit->max_stretch * (1 + limit->tolerance);
  }
  limits.stretch = options.stretch.value_or(limits.stretch);
  return limits;
}

class SimulatedAudit final : public StepObserver {
 public:
  SimulatedAudit(audit::MotionAudit& findings, EnergyBook& energies, Progress& progress)
      : findings_(findings), energies_(energies), progress_(progress) {}

  void begin(const Simulation& simulation) override { add(simulation); }
  void after_step(const Simulation& simulation, const StepReport&, double) override {
    add(simulation);
    ++progress_.done;
  }

 private:
  void add(const Simulation& simulation) {
    const State& state = simulation.state();
    const std::vector<Collider> colliders = simulation.colliders(simulation.time());
    findings_.add({state.step, simulation.time(), state.x, colliders});
    energies_.add(simulation.energies());
  }

  audit::MotionAudit& findings_;
  EnergyBook& energies_;
  Progress& progress_;
};

void audit_simulation(const Scene& scene, std::int64_t steps, EnergyBook& energies, AuditReport& report,
                      const std::stop_token& stop, Progress& progress) {
  progress.begin("auditing", "steps", steps);
  SimulatedAudit observer(report.findings, energies, progress);
  const std::array<StepObserver*, 1> observers{&observer};
  try {
    Simulation simulation(scene.simulation, Timing::none, make_stop(stop));
    run_steps(simulation, steps, observers, stop);
    report.duration = simulation.time();
  } catch (const DivergedError& diverged) {
    report.divergence = diverged.what();
  } catch (const Interrupted&) {
  }
}

void audit_recording(MotionReader& motion, const System& system, std::int64_t steps, EnergyBook& energies,
                     AuditReport& report, const std::stop_token& stop, Progress& progress) {
  progress.begin("auditing", "states", static_cast<std::int64_t>(motion.states()));
  std::int64_t before = 0;
  for (std::size_t i = 0; i < motion.states() && !stop.stop_requested(); ++i) {
    const State& state = motion.state(i);
    if (state.step > steps) break;
    report.gaps = report.gaps || state.step > before + 1;
    before = state.step;
    const double time = static_cast<double>(state.step) * system.whole_step;
    const std::vector<Collider> colliders = system.colliders_at(time);
    report.findings.add({state.step, time, state.x, colliders});
    report.duration = time;
    ++progress.done;
  }
  for (std::int64_t step = 0; step <= before; ++step) energies.add(motion.row(step).energies);
}

}  // namespace

AuditReport audit_motion(const Scene& scene, const std::shared_ptr<MotionReader>& recorded, const AuditOptions& options,
                         const std::stop_token& stop, Progress& progress) {
  const System system = make_system(scene.simulation);
  const std::string file = shown(scene.file);
  try {
    const bool imported = recorded && recorded->header().imported;
    AuditReport report{
        .file = file,
        .limits = limits_of(scene, options, imported),
        .findings = {audited_cloth(scene, system, options, imported), limits_of(scene, options, imported)},
        .energy = {}};
    EnergyBook energies(scene.simulation.step);
    if (recorded) {
      const std::int64_t steps = options.steps.value_or(recorded->last_step());
      audit_recording(*recorded, system, steps, energies, report, stop, progress);
    } else {
      audit_simulation(scene, options.steps.value_or(scene.step_count()), energies, report, stop, progress);
    }
    report.energy = energies.judge();
    report.energy.not_judged =
        imported ? "masses and springs of an imported motion are not known" : cause_of_rises(scene, system);
    report.interrupted = stop.stop_requested();
    return report;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{}: cannot be audited: {}", file, error.what()));
  }
}

}  // namespace drape
