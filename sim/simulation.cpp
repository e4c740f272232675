#include "drape/sim/simulation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/bytes.hpp"
#include "drape/core/error.hpp"
#include "drape/sim/schemes/method_choice.hpp"
#include "drape/sim/settings.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/spring_network.hpp"
#include "sim/step_objective.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

void require_rows(const char* what, Eigen::Index rows, int vertices) {
  if (rows == vertices) return;
  throw UsageError(fmt::format("the cloth has {} vertices and {} {}", vertices, rows, what));
}

void require_vertex(const char* what, int vertex, int vertices) {
  if (vertex >= 0 && vertex < vertices) return;
  throw UsageError(fmt::format("a {} has vertex {}, but the vertices are 0 to {}", what, vertex, vertices - 1));
}

std::unique_ptr<StabilityGuard> make_asked_guard(const SimulationSettings& settings, const System& system) {
  auto guard = make_guard(settings, system);
  if (settings.integrator.allow_unstable) return guard;
  if (const auto problem = guard->problem()) throw UsageError(*problem);
  return guard;
}

SimulationSettings valid(SimulationSettings settings) {
  require_valid(settings);
  return with_method(std::move(settings));
}

State initial_state(const Cloth& cloth) {
  State state{.x = cloth.positions, .v = cloth.velocities, .step = 0};
  for (const int pin : cloth.pins) state.v.row(pin).setZero();
  return state;
}

}  // namespace

void require_valid(const SimulationSettings& settings) {
  if (!(settings.step > 0) || !std::isfinite(settings.step)) {
    throw UsageError(fmt::format("the step must be above 0 s, found {:g} s", settings.step));
  }
  const Cloth& cloth = settings.cloth;
  const int vertices = cloth.vertex_count();
  require_rows("velocities", cloth.velocities.rows(), vertices);
  if (cloth.rest.rows() > 0) require_rows("rest positions", cloth.rest.rows(), vertices);  // springs do not need it
  require_rows("masses", cloth.masses.size(), vertices);
  for (const Triangle& triangle : cloth.triangles) {
    for (const int vertex : triangle) require_vertex("triangle", vertex, vertices);
  }
  for (const Spring& spring : cloth.springs) {
    for (const int vertex : {spring.i, spring.j}) require_vertex("spring", vertex, vertices);
  }
  for (const int pin : cloth.pins) require_vertex("pin", pin, vertices);
  for (const Seam& seam : cloth.seams) {
    for (const SeamTie& tie : seam.ties) {
      for (const int vertex : {tie.vertex, tie.edge[0], tie.edge[1]}) require_vertex("seam", vertex, vertices);
    }
  }
  if (std::ranges::adjacent_find(cloth.pins, std::greater_equal<>()) == cloth.pins.end()) return;
  throw UsageError("the pins must be ascending, each once");
}

/// Parts of a simulation. They refer to each other, so the object does not move in memory.
class Simulation::Motion {
 public:
  SimulationSettings settings;
  Stop stop;
  Threads threads;
  std::vector<double> effect_seconds;
  std::optional<System> system;  // always set; replaced in every phase
  std::vector<PinPhase> phases;  // sorted by step, from 0 on
  std::size_t phase = 0;
  State state;
  Simulation::Checkpoint before;  // state before the last step, if it may be needed
  StepForces forces;
  std::unique_ptr<StabilityGuard> guard;
  std::unique_ptr<Scheme> scheme;
  Eigen::VectorXd per_vertex;        // scratch for energies(), to avoid allocations
  Vertices ignored;                  // scratch for energies(): an unused gradient
  StabilityGuard::EnergyNow energy;  // K + E

  Motion(SimulationSettings given, Timing timing, const Stop& asked)
      : settings(valid(std::move(given))),
        stop(asked),
        threads(settings.threads, settings.spare_threads),
        effect_seconds(timing == Timing::effects ? settings.effects.size() : 0, 0.0),
        system(make_system(settings, measured(), stop, threads)),
        phases(pin_phases(settings.cloth.pins, system->pin_releases)),
        state(initial_state(settings.cloth)),
        forces(*system, state),
        guard(make_asked_guard(settings, *system)),
        scheme(make_scheme()),
        energy([this](double enough) {
          const std::optional<double> bound = scheme->energy_bound(state);
          return bound && *bound <= enough ? *bound : present_energy();
        }) {
    guard->begin(state, present_energy());
  }
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  StepReport step();
  /// Takes a step by a function of the scheme. Restores the state at its start if it is interrupted.
  template <class Advance>
  StepReport take(const Advance& advance);
  /// Returns an error if the last step gained energy or did not end in finite numbers.
  std::optional<DivergedError> find_fault();
  void restore(const Simulation::Checkpoint& checkpoint);
  Energies energies();
  /// Returns K + E [J].
  double present_energy() {
    const Energies now = energies();
    return now.kinetic + now.elastic;
  }
  std::vector<Energies> piece_energies();
  [[nodiscard]] double time() const { return static_cast<double>(state.step) * settings.step; }
  /// Returns true if a step checks for a stop after its start.
  [[nodiscard]] bool may_be_interrupted() const {
    const bool long_steps = !is_explicit(settings.integrator.method) || settings.accuracy || system->substeps > 1 ||
                            !system->filters.empty();
    return stop.possible() && long_steps;
  }
  /// Replaces the system and the scheme if the pins of the next step differ.
  void enter_phase();
  /// Returns the scheme for the system and the settings.
  std::unique_ptr<Scheme> make_scheme();
  /// Returns a value from the scheme, or an empty one if its creation was interrupted.
  template <class Query>
  auto query_scheme(const Query& query) const -> decltype(query(*scheme)) {
    return scheme ? query(*scheme) : decltype(query(*scheme)){};
  }
  /// Returns the sink for the effects' computing times, or null if they are not measured.
  std::vector<double>* measured() { return effect_seconds.empty() ? nullptr : &effect_seconds; }
  /// @param growth of the energy, see BlowUpWatch; absent: the numbers are no longer finite
  [[nodiscard]] DivergedError diverged_by(std::optional<double> growth) const {
    return diverged(state, time(), growth, guard->remedy());
  }
};

void Simulation::Motion::enter_phase() {
  std::size_t now = phases.size() - 1;
  while (phases[now].first_step > state.step) --now;
  if (now == phase && scheme) return;
  scheme.reset();  // refers to the system
  phase = now;
  settings.cloth.pins = phases[now].pins;
  system.emplace(make_system(settings, measured(), stop, threads));
  scheme = make_scheme();  // remains null if interrupted
}

std::unique_ptr<Scheme> Simulation::Motion::make_scheme() {
  return drape::make_scheme(settings, *system, *guard,
                            [this](double step) { return make_system(settings, step, measured(), stop, threads); });
}

template <class Advance>
StepReport Simulation::Motion::take(const Advance& advance) {
  StepReport report;
  try {
    report = advance();
  } catch (const Interrupted&) {
    restore(before);
    throw;
  }
  ++state.step;
  return report;
}

std::optional<DivergedError> Simulation::Motion::find_fault() {
  // Any non-finite position makes this norm non-finite, and any such velocity its vertex's position.
  const std::optional<double> size = scheme->size();
  if (!std::isfinite(size ? *size : norm(threads, state.x))) return diverged_by(std::nullopt);
  const std::optional<double> growth = guard->check_step(state, forces.push(), forces.constant(), energy);
  // A step of backward Euler in place of another scheme's has its own energy balance.
  if (growth && !scheme->first_order()) return diverged_by(growth);
  return std::nullopt;
}

StepReport Simulation::Motion::step() {
  stop.check();
  if (phases.size() > 1) enter_phase();
  if (may_be_interrupted() || scheme->can_redo()) {
    before.state = state;
    if (const EnergyMemory* memory = guard->memory()) before.energy_memory = *memory;
  }
  StepReport report = take([this] { return scheme->advance(state, forces); });
  std::optional<DivergedError> fault = find_fault();
  if (fault && scheme->can_redo()) {
    const int iterations = report.iterations;
    restore(before);
    report = take([this] { return scheme->redo(state, forces); });
    report.iterations += iterations;
    report.redone = true;
    fault = find_fault();
  }
  if (fault) throw DivergedError(*fault);
  return report;
}

void Simulation::Motion::restore(const Simulation::Checkpoint& checkpoint) {
  state = checkpoint.state;
  if (checkpoint.energy_memory) guard->restore(*checkpoint.energy_memory);
}

Energies Simulation::Motion::energies() {
  const Eigen::VectorXd& m = settings.cloth.masses;
  ignored.setZero(state.x.rows(), 3);
  double elastic = system->network().add_value_gradient(state.x, ignored);
  for (const auto& one : system->energies) {
    if (one->stored()) elastic += one->add_gradient(state.x, time(), ignored);
  }
  per_vertex = state.v.rowwise().squaredNorm();
  const double kinetic = 0.5 * m.dot(per_vertex);
  per_vertex.noalias() = state.x * system->gravity;
  return {.kinetic = kinetic,
          .gravity = 0 - m.dot(per_vertex),  // avoids −0
          .elastic = elastic};
}

std::vector<Energies> Simulation::Motion::piece_energies() {
  const Cloth& cloth = settings.cloth;
  std::vector<Energies> all(cloth.pieces.size());
  if (all.empty()) return all;
  const std::vector<int> numbers = pieces_of_vertices(cloth);
  const auto piece_of = [&](int vertex) -> Energies& {
    return numbers.empty() ? all.front() : all[static_cast<std::size_t>(numbers[static_cast<std::size_t>(vertex)])];
  };
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    piece_of(i).kinetic += cloth.masses[i] / 2 * state.v.row(i).squaredNorm();
    piece_of(i).gravity -= cloth.masses[i] * state.x.row(i).dot(system->gravity);
  }
  for (const Spring& s : system->springs) {
    const double longer = (state.x.row(s.i) - state.x.row(s.j)).norm() - s.rest_length;
    piece_of(s.i).elastic += s.stiffness / 2 * longer * longer;
  }
  ignored.setZero(state.x.rows(), 3);
  for (const auto& energy : system->energies) {
    const bool whole = energy->piece < 0;
    if (!energy->stored() || (whole && all.size() != 1)) continue;
    all[static_cast<std::size_t>(std::max(0, energy->piece))].elastic += energy->add_gradient(state.x, time(), ignored);
  }
  return all;
}

Simulation::Simulation(SimulationSettings settings, Timing timing, const Stop& stop)
    : motion_(std::make_unique<Motion>(std::move(settings), timing, stop)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

StepReport Simulation::step() { return motion_->step(); }

void Simulation::undo_step() {
  if (motion_->may_be_interrupted()) motion_->restore(motion_->before);
}

void Simulation::restore(const State& state) {
  motion_->state = state;
  motion_->guard->begin(state, motion_->present_energy());
}

Simulation::Checkpoint Simulation::checkpoint() const {
  const EnergyMemory* memory = motion_->guard->memory();
  return {motion_->state, memory == nullptr ? std::nullopt : std::optional(*memory)};
}

void Simulation::restore(const Checkpoint& checkpoint) { motion_->restore(checkpoint); }

const State& Simulation::state() const { return motion_->state; }
double Simulation::time() const { return motion_->time(); }
const SimulationSettings& Simulation::settings() const { return motion_->settings; }
const std::vector<Spring>& Simulation::springs() const { return motion_->system->springs; }
const std::vector<double>& Simulation::effect_seconds() const { return motion_->effect_seconds; }
Energies Simulation::energies() const { return motion_->energies(); }
std::vector<Energies> Simulation::piece_energies() const { return motion_->piece_energies(); }
bool Simulation::only_loses_energy() const {
  const System& system = *motion_->system;
  return (!system.filters.empty() || !system.contacts.empty()) && system.only_loses_energy();
}
bool Simulation::has_push() const {
  return std::ranges::any_of(motion_->system->forces, [](const auto& force) { return force->of_contact(); });
}
double Simulation::residual() const {
  return motion_->query_scheme([](Scheme& scheme) { return scheme.residual(); });
}
double Simulation::error() const {
  return motion_->query_scheme([](Scheme& scheme) { return scheme.error(); });
}
double Simulation::residual_force() const {
  return motion_->query_scheme([](Scheme& scheme) { return scheme.residual_force(); });
}
double Simulation::weight() const { return motion_->settings.cloth.masses.sum() * motion_->system->gravity.norm(); }
std::optional<Accuracy> Simulation::accuracy() const {
  return motion_->query_scheme([](const Scheme& scheme) { return scheme.accuracy(); });
}
std::vector<Collider> Simulation::colliders(double time) const { return motion_->system->colliders_at(time); }

std::uint64_t hash_of(const State& state) {
  Hash hash;
  hash.add(&state.step, sizeof state.step);
  const auto add = [&hash](const auto& numbers) {
    hash.add(numbers.data(), static_cast<std::size_t>(numbers.size()) * sizeof(double));
  };
  for (const Vertices* vertices : {&state.x, &state.v, &state.restraint.acceleration}) add(*vertices);
  add(state.restraint.tensions);
  hash.add(state.contact_forces.data(), state.contact_forces.size() * sizeof(ContactForce));
  if (state.substeps != 0) hash.add(&state.substeps, sizeof state.substeps);
  return hash.value();
}

}  // namespace drape
