#include "sim/schemes/registry.hpp"

#include <array>

#include "sim/schemes/backward_euler.hpp"
#include "sim/schemes/condition_guard.hpp"
#include "sim/schemes/safe_step_guard.hpp"
#include "sim/schemes/semi_implicit_euler.hpp"
#include "sim/solvers/local_global.hpp"
#include "sim/solvers/newton.hpp"
#include "sim/solvers/quasi_newton.hpp"

namespace drape {
namespace {

std::unique_ptr<Scheme> make_semi_implicit(const IntegratorSettings& /*settings*/, const System& system) {
  return std::make_unique<SemiImplicitEuler>(system);
}

template <class Solver>
std::unique_ptr<Scheme> make_backward_euler(const IntegratorSettings& settings, const System& system) {
  return std::make_unique<BackwardEuler>(
      system, [&](const StepObjective& objective) { return std::make_unique<Solver>(system, objective, settings); });
}

template <class Guard>
std::unique_ptr<StabilityGuard> make_guard(const System& system) {
  return std::make_unique<Guard>(system);
}

constexpr std::array methods{
    MethodType{Method::semi_implicit, false, make_semi_implicit, make_guard<SafeStepGuard>},
    MethodType{Method::implicit, true, make_backward_euler<Newton>, make_guard<ConditionGuard>},
    MethodType{Method::liu13, true, make_backward_euler<LocalGlobal>, make_guard<ConditionGuard>},
    MethodType{Method::quasi_newton, true, make_backward_euler<QuasiNewton>, make_guard<ConditionGuard>},
};
static_assert(methods.size() == method_names.size());

}  // namespace

const MethodType& method_type(Method method) { return methods.at(static_cast<std::size_t>(method)); }

std::optional<std::string> stability_problem(const SimulationSettings& settings, const System& system) {
  return method_type(settings.integrator.method).make_guard(system)->problem();
}

}  // namespace drape
