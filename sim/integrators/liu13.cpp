#include "sim/integrators/liu13.hpp"

namespace drape {
namespace {

constexpr int default_max_iterations = 100;  // the homework's

}  // namespace

Liu13::Liu13(const System& system, const IntegratorSettings& settings)
    : ImplicitEuler(system, settings, default_max_iterations),
      factor_(system, Precision::automatic),
      change_(Vertices::Zero(system.cloth.vertex_count(), 3)) {}

double Liu13::iterate(Point& point) {
  factor_.solve(point.gradient, change_);
  kernels().add_multiple(static_cast<std::size_t>(point.x.size()), -1.0, change_.data(), point.x.data());
  point.value = objective().evaluate(point.x, point.gradient);
  return norm(change_);
}

}  // namespace drape
