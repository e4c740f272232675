#include "sim/effects/contact.hpp"

#include <fmt/format.h>

#include "core/keys.hpp"
#include "sim/settings.hpp"

namespace drape {

void describe_contact(Keys& keys, std::optional<double>& stiffness, std::optional<Response>& response, double& friction,
                      std::optional<double>& restitution, const std::string& without_restitution) {
  keys.add("stiffness", &stiffness, "1/s²",
           "Outward acceleration per metre of depth within that reach: a push, and by explicit methods instead of "
           "contact that is solved for. Default of a push: 8000.")
      .at_least(0);
  keys.choice(
      "response", response, {"explicit", "implicit", "solved"},
      "Contact without a push, \"solved\" for with the whole step: its total energy never rises, and `stiffness` does "
      "not act. Or a push that is evaluated once per step, or is solved for together with the springs. Default: "
      "\"solved\" by explicit methods unless a `stiffness` is given, \"explicit\" by the others.");
  keys.add("friction", &friction, "",
           "Coulomb's coefficient µ: a vertex at rest on a slope of tan θ ≤ µ stays there; 0 is frictionless.")
      .at_least(0);
  keys.add("restitution", &restitution, "",
           "Fraction of its impact speed with which a vertex rebounds: 1 all of it, 0 none" + without_restitution + ".")
      .at_least(0)
      .at_most(1);
}

bool has_impulses(const SimulationSettings& settings) {
  return is_explicit(settings.integrator.method) || settings.integrator.method == Method::automatic;
}

std::optional<std::string> solved_problem(const SimulationSettings& settings) {
  const StepMethod how = settings.integrator.step_method();
  if (is_explicit(how.method) || how.method == Method::automatic) return std::nullopt;
  if (settings.accuracy) {
    return "contact that is \"solved\" has no estimate of its error yet: omit 'accuracy' in [time]";
  }
  if (how.scheme != TimeScheme::backward_euler) {
    return "contact can be \"solved\" by scheme = \"backward-euler\" alone";
  }
  return std::nullopt;
}

void ContactLaw::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  if (response == Response::solved) {
    if (const auto wrong = solved_problem(settings)) problem("response", *wrong);
    return;
  }
  if (response == Response::implicit_energy) {
    if (is_explicit(settings.integrator.method)) {
      problem("response", fmt::format("{} evaluates every force once per step and solves for nothing, so the push can "
                                      "only be \"explicit\"; the implicit methods also allow \"implicit\"",
                                      explicit_title(settings.integrator.method)));
    }
    return;
  }
  // A vertex on the explicit penalty is a harmonic oscillator of frequency √k, which every step that evaluates the
  // force at its start turns unstable beyond h·√k = 2, whatever the method does with the springs.
  // Substeps are short enough, those of an accuracy and those that are chosen.
  if (settings.accuracy || settings.integrator.method == Method::automatic) return;
  const double h = settings.step / settings.integrator.substep_count();
  const double product = h * std::sqrt(stiffness);
  if (product > 2) {
    problem("stiffness",
            fmt::format("an explicit push is unstable where step·√stiffness > 2, and here it is {:.3g}: with step = "
                        "{:g} s the stiffness can be at most {:.4g}, or with this stiffness the step at most {:.3g} s",
                        product, h, 4 / (h * h), 2 / std::sqrt(stiffness)));
  }
}

std::vector<int> free_vertices(const Cloth& cloth) {
  std::vector<int> vertices;
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    if (!std::binary_search(cloth.pins.begin(), cloth.pins.end(), i)) vertices.push_back(i);
  }
  return vertices;
}

}  // namespace drape
