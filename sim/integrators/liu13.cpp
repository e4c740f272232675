#include "sim/integrators/liu13.hpp"

namespace drape {
namespace {

constexpr int default_max_iterations = 100;  // the homework's

}  // namespace

Liu13::Liu13(const System& system, const IntegratorSettings& settings)
    : ImplicitEuler(system, settings, default_max_iterations),
      factor_(system, Precision::automatic),
      change_(Vertices::Zero(system.cloth.vertex_count(), 3)) {}

double Liu13::iterate(Vertices& x, const Vertices& gradient) {
  factor_.solve(gradient, change_);
  x -= change_;
  return change_.norm();
}

}  // namespace drape
