#include "sim/system.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "sim/contact/impulse_contact.hpp"
#include "sim/contact/seams.hpp"
#include "sim/dashpots.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/velocity_field.hpp"

namespace drape {
namespace {

constexpr int most_turns = 4;  // of filters that undo each other's changes

}  // namespace

const SpringNetwork& System::network() const {
  if (!network_) network_ = std::make_unique<SpringNetwork>(springs, cloth.vertex_count(), threads);
  return *network_;
}

StiffnessBound System::stiffness_bound() const {
  StiffnessBound bound{.springs = springs, .vertices = Eigen::VectorXd::Zero(cloth.vertex_count())};
  for (const auto& energy : energies) energy->add_bound(bound);
  return bound;
}

std::vector<Collider> System::colliders_at(double at) const {
  std::vector<Collider> shapes;
  for (const auto& motion : colliders) shapes.push_back(motion->at(at));
  return shapes;
}

bool System::only_loses_energy() const {
  const bool rests = std::ranges::all_of(colliders, [](const auto& collider) { return collider->rests(); });
  if (!rests || !pin_motions.empty() || !fields.empty() || !cloth.seams.empty()) return false;
  const State at_rest{.x = cloth.positions, .v = Vertices::Zero(cloth.vertex_count(), 3), .step = 0};
  Vertices push = at_rest.v;
  for (const auto& force : forces) {
    if (force->of_contact()) continue;
    if (!force->constant()) return false;
    force->add(at_rest, 0, push);
  }
  return push.isApprox(cloth.masses * gravity.transpose());
}

bool System::filter(State& state, Vertices& way) const {
  for (const auto& filter : filters) {
    filter->apply(state.x, time(state.step), step, way);
  }
  bool changed = filters.size() > 1;
  for (int turn = 0; changed && turn < most_turns; ++turn) {
    changed = false;
    for (const auto& filter : filters) changed = filter->adjust(state.x, time(state.step), step, way) || changed;
  }
  bool first = true, converged = !changed;
  for (const auto& filter : filters) {
    converged = converged && filter->done();
    const Restraint* restraint = filter->restraint();
    if (restraint == nullptr) continue;
    if (std::exchange(first, false)) {
      state.restraint = *restraint;
    } else {  // of other cloths
      state.restraint.acceleration += restraint->acceleration;
      state.restraint.tensions += restraint->tensions;
    }
  }
  return converged;
}

double System::tolerated_gain() const {
  double sum = 0;
  for (const auto& filter : filters) sum += filter->tolerated_gain();
  return sum;
}

bool System::move(State& state) const {
  const bool converged = filter(state, state.v);
  add_multiple(threads, step, state.v, state.x);
  place_pins(time(state.step + 1), state.x);
  for (const auto& filter : filters) filter->finish(state.v);
  return converged;
}

bool System::move(State& state, const Vertices& reached, Vertices& way) const {
  if (filters.empty()) {
    state.x = reached;
    return true;
  }
  way = (reached - state.x) / step;
  state.v -= way;
  const bool converged = filter(state, way);
  state.v += way;
  add_multiple(threads, step, way, state.x);
  place_pins(time(state.step + 1), state.x);
  drive_pins(time(state.step + 1), state.v);
  for (const auto& filter : filters) filter->finish(state.v);
  return converged;
}

namespace {

/// Sizes of a system's lists at one moment.
struct SystemSizes {
  std::size_t forces, fields, energies, dashpots, corrections, filters, contacts, limits;
  explicit SystemSizes(const System& system)
      : forces(system.forces.size()),
        fields(system.fields.size()),
        energies(system.energies.size()),
        dashpots(system.dashpots.size()),
        corrections(system.corrections.size()),
        filters(system.filters.size()),
        contacts(system.contacts.size()),
        limits(system.limits.size()) {}
};

/// Timer that adds its lifetime to a number of seconds.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point begin_ = Clock::now();
};

template <class Base>
struct Timed : Base {
  std::shared_ptr<Base> inner;
  double& seconds;
  Timed(std::shared_ptr<Base> i, double& s) : inner(std::move(i)), seconds(s) {}
};

struct TimedForce final : Timed<Force> {
  using Timed::Timed;
  [[nodiscard]] bool constant() const override { return inner->constant(); }
  [[nodiscard]] bool depends_on_velocity() const override { return inner->depends_on_velocity(); }
  [[nodiscard]] bool of_contact() const override { return inner->of_contact(); }
  void add(const State& state, double time, Vertices& force) const override {
    const Stopwatch watch(seconds);
    inner->add(state, time, force);
  }
  [[nodiscard]] double stiffness_bound() const override { return inner->stiffness_bound(); }
};

struct TimedHessian final : Timed<EnergyHessian> {
  using Timed::Timed;
  void linearise(const Vertices& x, double time, double concavity) override {
    const Stopwatch watch(seconds);
    inner->linearise(x, time, concavity);
  }
  void add_product(const Vertices& vector, Vertices& product) const override {
    const Stopwatch watch(seconds);
    inner->add_product(vector, product);
  }
  void add_blocks(HessianBlocks& blocks) const override {
    const Stopwatch watch(seconds);
    inner->add_blocks(blocks);
  }
};

struct TimedEnergy final : Timed<Energy> {
  TimedEnergy(std::shared_ptr<Energy> timed, double& total) : Timed(std::move(timed), total) { piece = inner->piece; }
  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override {
    const Stopwatch watch(seconds);
    return inner->add_gradient(x, time, gradient);
  }
  void add_bound(StiffnessBound& bound) const override { inner->add_bound(bound); }
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override {
    return std::make_unique<TimedHessian>(inner->make_hessian(), seconds);
  }
  [[nodiscard]] bool stored() const override { return inner->stored(); }
};

struct TimedDashpots final : Timed<Dashpots> {
  using Timed::Timed;
  void set_directions(const Vertices& x) override {
    const Stopwatch watch(seconds);
    inner->set_directions(x);
  }
  void add_product(const Vertices& v, Vertices& product) const override {
    const Stopwatch watch(seconds);
    inner->add_product(v, product);
  }
  void add_blocks(double factor, HessianBlocks& blocks) const override {
    const Stopwatch watch(seconds);
    inner->add_blocks(factor, blocks);
  }
  void add_bound(double factor, StiffnessBound& bound) const override { inner->add_bound(factor, bound); }
};

struct TimedCorrection final : Timed<Correction> {
  using Timed::Timed;
  void apply(State& state, double h) const override {
    const Stopwatch watch(seconds);
    inner->apply(state, h);
  }
};

struct TimedFilter final : Timed<MotionFilter> {
  using Timed::Timed;
  void begin(const State& state, double time) override {
    const Stopwatch watch(seconds);
    inner->begin(state, time);
  }
  void apply(const Vertices& x, double time, double h, Vertices& v) override {
    const Stopwatch watch(seconds);
    inner->apply(x, time, h, v);
  }
  bool adjust(const Vertices& x, double time, double h, Vertices& v) override {
    const Stopwatch watch(seconds);
    return inner->adjust(x, time, h, v);
  }
  void finish(Vertices& v) override {
    const Stopwatch watch(seconds);
    inner->finish(v);
  }
  [[nodiscard]] const Restraint* restraint() const override { return inner->restraint(); }
  [[nodiscard]] double tolerated_gain() const override { return inner->tolerated_gain(); }
  [[nodiscard]] bool done() const override { return inner->done(); }
};

struct TimedContacts final : Timed<ContactSource> {
  using Timed::Timed;
  void begin(const Vertices& x, double start, double end) override {
    const Stopwatch watch(seconds);
    inner->begin(x, start, end);
  }
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override {
    const Stopwatch watch(seconds);
    inner->find(target, source, held, contacts);
  }
  [[nodiscard]] bool separates() const override { return inner->separates(); }
};

template <class TimedKind, class List>
void wrap(List& list, std::size_t from, double& seconds) {
  for (std::size_t i = from; i < list.size(); ++i) list[i] = std::make_unique<TimedKind>(std::move(list[i]), seconds);
}

/// Wraps everything added to the system after `before` so that its computing time is added to `seconds`, which must
/// outlive the system. Without timing there is no overhead.
void time_additions(System& system, const SystemSizes& before, double& seconds) {
  wrap<TimedForce>(system.forces, before.forces, seconds);
  wrap<TimedForce>(system.fields, before.fields, seconds);
  wrap<TimedEnergy>(system.energies, before.energies, seconds);
  wrap<TimedDashpots>(system.dashpots, before.dashpots, seconds);
  wrap<TimedCorrection>(system.corrections, before.corrections, seconds);
  wrap<TimedFilter>(system.filters, before.filters, seconds);
  wrap<TimedContacts>(system.contacts, before.contacts, seconds);
  wrap<TimedContacts>(system.limits, before.limits, seconds);
}

/// Adds the energy for velocity fields in implicit steps.
void add_drag(const IntegratorSettings& integrator, System& system) {
  if (system.fields.empty() || is_explicit(integrator.method)) return;
  const double solved = minimised_fraction(integrator.scheme) * system.step;
  auto drag = std::make_unique<FieldDrag>(system, solved, integrator.method == Method::liu13);
  system.drag = drag.get();
  system.energies.push_back(std::move(drag));
}

/// Adds the energies for dashpots in implicit steps.
void add_dissipations(const IntegratorSettings& integrator, System& system) {
  if (is_explicit(integrator.method)) return;
  const double shortest = minimised_fraction(integrator.scheme) * system.step;
  for (const auto& dashpots : system.dashpots) {
    auto dissipation = std::make_unique<StepDissipation>(dashpots, shortest, system.cloth.positions, system.threads);
    system.dissipations.push_back(dissipation.get());
    system.energies.push_back(std::move(dissipation));
  }
}

/// Adds everything that acts on the cloth.
void install_effects(const SimulationSettings& settings, std::vector<double>* effect_seconds, const Stop& stop,
                     System& system) {
  system.stop = stop;
  for (std::size_t i = 0; i < settings.effects.size(); ++i) {
    const SystemSizes before(system);
    settings.effects[i].install(system);
    for (std::size_t f = before.filters; f < system.filters.size(); ++f) system.filters[f]->set_stop(stop);
    if (effect_seconds != nullptr) time_additions(system, before, (*effect_seconds)[i]);
  }
  add_drag(settings.integrator, system);
  add_dissipations(settings.integrator, system);
  if (!system.cloth.seams.empty()) system.contacts.push_back(std::make_shared<SeamContacts>(system.cloth));
  if (!is_explicit(settings.integrator.method)) return;
  system.limits.clear();
  if (system.contacts.empty()) return;
  system.filters.push_back(std::make_unique<ImpulseContact>(system));
  system.filters.back()->set_stop(stop);
  system.contacts.clear();
}

}  // namespace

System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds, const Stop& stop,
                   const Threads& threads) {
  const int substeps = settings.accuracy ? 1 : settings.integrator.substep_count();
  System system(settings.cloth, settings.step / substeps, threads);
  system.whole_step = settings.step;
  system.substeps = substeps;
  install_effects(settings, effect_seconds, stop, system);
  return system;
}

System make_system(const SimulationSettings& settings, double step, std::vector<double>* effect_seconds,
                   const Stop& stop, const Threads& threads) {
  System system(settings.cloth, step, threads);
  install_effects(settings, effect_seconds, stop, system);
  return system;
}

}  // namespace drape
