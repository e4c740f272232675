#include "sim/schemes/registry.hpp"

#include <array>
#include <utility>

#include "sim/schemes/backward_euler.hpp"
#include "sim/schemes/explicit_schemes.hpp"
#include "sim/schemes/sdirk2.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/schemes/substeps.hpp"
#include "sim/solvers/local_global.hpp"
#include "sim/solvers/newton.hpp"
#include "sim/solvers/quasi_newton.hpp"

namespace drape {
namespace {

template <class Explicit>
std::unique_ptr<Scheme> make_explicit(const IntegratorSettings& /*settings*/, const System& system) {
  return std::make_unique<Explicit>(system);
}

template <class Solver>
std::unique_ptr<Scheme> make_implicit(const IntegratorSettings& settings, const System& system) {
  const auto make_solver = [&](const StepObjective& objective) {
    return std::make_unique<Solver>(system, objective, settings);
  };
  if (settings.scheme == TimeScheme::sdirk2) return std::make_unique<Sdirk2>(system, make_solver);
  return std::make_unique<BackwardEuler>(system, make_solver);
}

std::unique_ptr<StabilityGuard> make_safe_step_guard(const IntegratorSettings& settings, const System& system) {
  return std::make_unique<SafeStepGuard>(explicit_title(settings.method), system);
}

std::unique_ptr<StabilityGuard> make_implicit_guard(const IntegratorSettings& settings, const System& system) {
  if (settings.scheme == TimeScheme::sdirk2) return std::make_unique<Sdirk2Guard>(system);
  return std::make_unique<ConditionGuard>(system);
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
