#include "sim/schemes/registry.hpp"

#include <array>
#include <utility>

#include "sim/schemes/explicit_schemes.hpp"
#include "sim/schemes/implicit_schemes.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/schemes/substeps.hpp"
#include "sim/solvers/local_global.hpp"
#include "sim/solvers/newton.hpp"
#include "sim/solvers/quasi_newton.hpp"

namespace drape {
namespace {

/// Factories of a time scheme of the implicit methods.
struct SchemeType {
  double minimised;  ///< see minimised_fraction()
  std::unique_ptr<Scheme> (*make)(const System& system, const MinimisingScheme::MakeSolver& make_solver);
  std::unique_ptr<StabilityGuard> (*make_guard)(const System& system);
};

template <class Type, class Guard>
constexpr SchemeType scheme_row(double minimised) {
  return {minimised,
          [](const System& system, const MinimisingScheme::MakeSolver& make_solver) -> std::unique_ptr<Scheme> {
            return std::make_unique<Type>(system, make_solver);
          },
          [](const System& system) -> std::unique_ptr<StabilityGuard> { return std::make_unique<Guard>(system); }};
}

/// The schemes in the order of the enumeration, as scheme_traits.
constexpr std::array scheme_types{
    scheme_row<BackwardEuler, ConditionGuard>(1),
    scheme_row<Sdirk2, Sdirk2Guard>(Sdirk2::gamma),
};
static_assert(scheme_types.size() == scheme_traits.size());

const SchemeType& scheme_type(TimeScheme scheme) { return scheme_types.at(static_cast<std::size_t>(scheme)); }

template <class Explicit>
std::unique_ptr<Scheme> make_explicit(const IntegratorSettings& /*settings*/, const System& system) {
  return std::make_unique<Explicit>(system);
}

template <class Solver>
std::unique_ptr<Scheme> make_implicit(const IntegratorSettings& settings, const System& system) {
  return scheme_type(settings.scheme).make(system, [&](const StepObjective& objective) {
    return std::make_unique<Solver>(system, objective, settings);
  });
}

std::unique_ptr<StabilityGuard> make_safe_step_guard(const IntegratorSettings& settings, const System& system) {
  return std::make_unique<SafeStepGuard>(traits_of(settings.method).title, system);
}

std::unique_ptr<StabilityGuard> make_implicit_guard(const IntegratorSettings& settings, const System& system) {
  return scheme_type(settings.scheme).make_guard(system);
}

constexpr std::array methods{
    MethodType{Method::semi_implicit, make_explicit<SemiImplicitEuler>, make_safe_step_guard},
    MethodType{Method::implicit, make_implicit<Newton>, make_implicit_guard},
    MethodType{Method::liu13, make_implicit<LocalGlobal>, make_implicit_guard},
    MethodType{Method::quasi_newton, make_implicit<QuasiNewton>, make_implicit_guard},
    MethodType{Method::verlet, make_explicit<Verlet>, make_safe_step_guard},
};
static_assert(methods.size() == method_count);

}  // namespace

const MethodType& method_type(Method method) { return methods.at(static_cast<std::size_t>(method)); }

double minimised_fraction(TimeScheme scheme) { return scheme_type(scheme).minimised; }

std::unique_ptr<StabilityGuard> make_guard(const SimulationSettings& settings, const System& system) {
  auto guard = method_type(settings.integrator.method).make_guard(settings.integrator, system);
  if (!settings.accuracy) return guard;
  return std::make_unique<SubstepGuard>(std::move(guard), settings.step);
}

std::unique_ptr<Scheme> make_scheme(const SimulationSettings& settings, const System& system,
                                    const StabilityGuard& guard,
                                    const std::function<System(double step)>& make_system) {
  if (!settings.accuracy) {
    auto scheme = method_type(settings.integrator.method).make(settings.integrator, system);
    if (system.substeps == 1) return scheme;
    return std::make_unique<DividedStep>(system, std::move(scheme));
  }
  const std::int64_t fewest = SubstepGuard::fewest_substeps(settings.step, guard.longest_step());
  return std::make_unique<SubstepScheme>(settings, fewest, make_system);
}

std::optional<std::string> stability_problem(const SimulationSettings& settings, const System& system) {
  return make_guard(settings, system)->problem();
}

}  // namespace drape
