#include "sim/effects/damping.hpp"

#include <cmath>

#include "core/keys.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

struct VelocityDecay final : Correction {
  double factor;
  explicit VelocityDecay(double f) : factor(f) {}
  void apply(State& state, double h) const override { state.v *= std::pow(factor, h); }
};

}  // namespace

void Damping::describe(Keys& keys) {
  keys.add("factor", &factor, "", "Fraction of every velocity left after one second; 1 means no damping.")
      .must_be_given()
      .above(0)
      .at_most(1);
}

void Damping::install(System& system) const { system.corrections.push_back(std::make_unique<VelocityDecay>(factor)); }

}  // namespace drape
