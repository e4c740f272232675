#include "sim/blow_up.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drape {
namespace {

Eigen::Index worst_vertex(const State& state) {
  Eigen::Index fastest = 0;
  for (Eigen::Index i = 0; i < state.v.rows(); ++i) {
    if (!state.x.row(i).allFinite() || !state.v.row(i).allFinite()) return i;
    if (state.v.row(i).stableNorm() > state.v.row(fastest).stableNorm()) fastest = i;
  }
  return fastest;
}

}  // namespace

double BlowUpWatch::limit(double ratio) {
  if (ratio >= 1) return limit_of_unstable_steps;
  return std::min(limit_of_unstable_steps, 4 * (1 + ratio) / (1 - ratio));
}

BlowUpWatch::BlowUpWatch(const System& system, double limit, int interval)
    : step_(system.whole_step), limit_(limit), interval_(interval) {
  // With every spring at its rest length, a relative rounding error ε of lengths leaves Σ k (εL)²/2.
  double scale = std::numeric_limits<double>::min();
  for (const Spring& s : system.springs) scale += s.stiffness * s.rest_length * s.rest_length;
  rounding_ = std::numeric_limits<double>::epsilon() * scale;
}

void BlowUpWatch::begin(const State& state, double energy) {
  books_ = {.explained = std::max(energy, rounding_), .looked_at = state.x, .work = 0};
}

std::optional<double> BlowUpWatch::look(const State& state, const Vertices& push, bool constant,
                                        const std::function<double()>& energy) {
  if (!constant) books_.work += step_ * std::abs(push.cwiseProduct(state.v).sum());
  if (state.step % interval_ != 0) return std::nullopt;
  if (constant) books_.work = std::abs(push.cwiseProduct(state.x - books_.looked_at).sum());
  books_.explained += books_.work;
  books_.looked_at = state.x;
  books_.work = 0;
  const double now = energy();
  if (!(now > limit_ * books_.explained)) return std::nullopt;
  return now / books_.explained;
}

DivergedError diverged(const State& state, double time, std::optional<double> growth, const std::string& remedy) {
  const Eigen::Index worst = worst_vertex(state);
  const double speed = state.v.row(worst).stableNorm();
  std::string text =
      fmt::format("the simulation diverged at step {} (t = {:g} s): vertex {} ", state.step, time, worst);
  text += std::isfinite(speed) && state.x.row(worst).allFinite() ? fmt::format("moves at {:.3g} m/s", speed)
                                                                 : "is no longer at a finite position";
  text += growth ? fmt::format(
                       " and the energy has grown to {:.2g} times the cloth's initial energy plus the work done on it",
                       *growth)
                 : " and the energy has grown without bound";
  return DivergedError(text + remedy);
}

}  // namespace drape
