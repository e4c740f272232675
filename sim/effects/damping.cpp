#include "drape/sim/effects/damping.hpp"

#include <cmath>

#include "core/keys.hpp"
#include "sim/dashpots.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

struct VelocityDecay final : Correction {
  double factor;
  const Threads& threads;
  VelocityDecay(double f, const Threads& by) : factor(f), threads(by) {}
  void apply(State& state, double h) const override { scale(threads, std::pow(factor, h), state.v, state.v); }
  [[nodiscard]] std::optional<double> decay(double h) const override { return std::pow(factor, h); }
};

}  // namespace

void Damping::describe(Keys& keys) {
  keys.add("factor", &factor, "", "Fraction of every velocity left after one second; 1 means no damping.")
      .must_be_given()
      .above(0)
      .at_most(1);
}

void Damping::install(System& system) const {
  system.corrections.push_back(std::make_unique<VelocityDecay>(factor, system.threads));
}

void InternalDamping::describe(Keys& keys) {
  keys.add("relaxation_time", &relaxation_time, "s",
           "Time τ: a spring of stiffness k has a dashpot with the damping coefficient τ·k, and bending likewise.")
      .must_be_given()
      .above(0);
}

void InternalDamping::install(System& system) const {
  const int count = system.cloth.vertex_count();
  system.damping_time = relaxation_time;
  if (!system.springs.empty()) {
    system.dashpots.push_back(std::make_shared<SpringDashpots>(system.springs, relaxation_time, count, system.threads));
  }
  if (!system.bending_elements.empty()) {
    system.dashpots.push_back(std::make_shared<BendingDashpots>(system.bending_elements, relaxation_time));
  }
}

}  // namespace drape
