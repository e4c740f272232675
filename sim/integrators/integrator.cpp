#include "sim/integrators/integrator.hpp"

#include <stdexcept>

#include "sim/integrators/implicit_newton.hpp"
#include "sim/integrators/liu13.hpp"
#include "sim/integrators/quasi_newton.hpp"
#include "sim/integrators/semi_implicit.hpp"

namespace drape {

std::unique_ptr<Integrator> make_integrator(const IntegratorSettings& settings, const System& system) {
  switch (settings.method) {
    case Method::semi_implicit:
      return std::make_unique<SemiImplicitEuler>(system);
    case Method::implicit:
      return std::make_unique<ImplicitNewton>(system, settings);
    case Method::liu13:
      return std::make_unique<Liu13>(system, settings);
    case Method::quasi_newton:
      return std::make_unique<QuasiNewton>(system, settings);
  }
  throw std::invalid_argument("no such method");
}

}  // namespace drape
