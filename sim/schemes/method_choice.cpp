#include "drape/sim/schemes/method_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drape/sim/effects/damping.hpp"
#include "sim/dashpots.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

// Typical times for the scenes in scenes/ [s].
constexpr double spring_of_substep = 3e-9, spring_of_iteration = 16e-9, substep = 0.5e-6;
// Quasi-Newton's iterations grow with the frequency of the springs, up to the point where Newton steps take over.
constexpr double iterations_per_substep = 2, most_iterations = 60;
constexpr double steps_of_backward_euler = 2;  // for an error of a hundredth of the cloth's size
// Newton steps of a step in contact, each with a factor of n^1.5 operations for n vertices: the mean over scenes whose
// cloth touches something for most of the time.
constexpr double iterations_in_contact = 15, factor_of_vertex = 0.15e-6;

/// Returns true if the effects allow a method, as far as the settings tell.
bool allowed(SimulationSettings settings, Method method, int substeps) {
  settings.integrator.method = method;
  settings.integrator.substeps = substeps;
  bool good = true;
  for (const Effect& effect : settings.effects) {
    effect.check(settings, [&](std::string_view, const std::string&) { good = false; });
  }
  return good;
}

/// Returns the mean number of times that an explicit substep evaluates an effect.
/// @param stiffness see estimated_step()
double evaluations(const Effect& effect, double substeps, double whole_step, double stiffness) {
  const auto* damping = effect.as<InternalDamping>();
  if (damping == nullptr) return 1;
  const auto kicks = static_cast<double>(DampingKick::kicks_in(static_cast<std::int64_t>(substeps)));
  const double frequency = 2 * stiffness / whole_step, duration = whole_step / kicks;
  return kicks / substeps * DampingKick::stages_for(duration * damping->relaxation_time * frequency * frequency);
}

bool touches(const SimulationSettings& settings) {
  return std::ranges::any_of(settings.effects, [](const Effect& effect) { return effect.touches(); });
}

}  // namespace

double estimated_step(const SimulationSettings& settings, Method method, double substeps, double stiffness) {
  const auto springs = static_cast<double>(settings.cloth.springs.size());
  const auto vertices = static_cast<double>(settings.cloth.vertex_count());
  double evaluated = 0, solved = 0;
  for (const Effect& effect : settings.effects) {
    evaluated += effect.cost().evaluated * evaluations(effect, substeps, settings.step, stiffness);
    solved += effect.cost().solved;
  }
  if (is_explicit(method)) return substeps * (substep + springs * spring_of_substep + vertices * evaluated);
  const double iterations = std::min(most_iterations, 1 + iterations_per_substep * stiffness);
  return substep + springs * spring_of_iteration * iterations + vertices * solved;
}

double estimated_contact(const SimulationSettings& settings, Method method) {
  if (is_explicit(method) || method == Method::liu13 || !touches(settings)) return 0;
  const auto vertices = static_cast<double>(settings.cloth.vertex_count());
  return iterations_in_contact * factor_of_vertex * vertices * std::sqrt(vertices);
}

MethodChoice choose_method(const SimulationSettings& settings) {
  SimulationSettings tried = settings;
  tried.integrator.method = Method::verlet;
  const System system = make_system(tried);
  const double longest = safe_step(system), ratio = settings.step / longest;
  const double taken = touches(settings) ? longest / calm_ratio : longest;
  const std::int64_t fewest = SubstepGuard::fewest_substeps(settings.step, taken);
  MethodChoice choice;
  choice.adapts = settings.accuracy.has_value();
  choice.substeps = settings.integrator.substeps.value_or(static_cast<int>(fewest));
  choice.verlet = estimated_step(settings, Method::verlet, choice.substeps, ratio);
  choice.contact = steps_of_backward_euler * estimated_contact(settings, Method::quasi_newton);
  choice.quasi_newton =
      steps_of_backward_euler * estimated_step(settings, Method::quasi_newton, 1, ratio) + choice.contact;
  if (!(ratio <= most_substeps)) {
    choice.only = true;
    choice.reason = "springs are too stiff for short steps";
    return choice;
  }
  const bool pushed = settings.step <= safe_step_of_pushes(system);
  if (!allowed(settings, Method::verlet, choice.substeps)) {
    choice.only = true;
    choice.reason = "velocity Verlet cannot have all that acts here";
    return choice;
  }
  choice.method = Method::verlet;
  if (!pushed || !allowed(settings, Method::quasi_newton, 1)) {
    choice.only = true;
    choice.reason = "pushes are too stiff for longer steps";
  } else if (choice.verlet <= choice.quasi_newton) {
    choice.reason = "the more accurate and the cheaper";
  } else {
    choice.method = Method::quasi_newton;
    choice.reason = "the cheaper";
  }
  return choice;
}

std::optional<Method> shared_method(std::span<const MethodChoice> choices) {
  double verlet = 0, quasi_newton = 0;
  std::optional<Method> only;
  for (const MethodChoice& choice : choices) {
    verlet += choice.verlet;
    quasi_newton += choice.quasi_newton;
    if (choice.only && only && only != choice.method) return std::nullopt;
    if (choice.only) only = choice.method;
  }
  if (only) return only;
  const auto like_first = [&](const MethodChoice& choice) { return choice.method == choices.front().method; };
  if (!choices.empty() && std::ranges::all_of(choices, like_first)) return choices.front().method;
  return verlet <= quasi_newton ? Method::verlet : Method::quasi_newton;
}

std::optional<Method> implied_method(const IntegratorSettings& integrator) {
  if (integrator.linear_solver != LinearSolver::automatic) return Method::implicit;
  const bool solved = integrator.stop || integrator.tolerance || integrator.max_iterations;
  return solved || integrator.scheme != TimeScheme::backward_euler ? std::optional(Method::quasi_newton) : std::nullopt;
}

void MethodChoice::apply(SimulationSettings& settings) const {
  settings.integrator.method = method;
  if (method == Method::verlet && !adapts) settings.integrator.substeps = substeps;
}

SimulationSettings with_method(SimulationSettings settings) {
  IntegratorSettings& integrator = settings.integrator;
  if (integrator.method != Method::automatic) return settings;
  if (const auto implied = implied_method(integrator)) {
    integrator.method = *implied;
  } else {
    choose_method(settings).apply(settings);
  }
  return settings;
}

}  // namespace drape
