#include "sim/effects/damping.hpp"

#include <cmath>

namespace drape {
namespace {

struct VelocityDecay final : Correction {
  double factor;
  explicit VelocityDecay(double f) : factor(f) {}
  void apply(State& state, double h) const override { state.v *= std::pow(factor, h); }
};

class Damping final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("factor", &factor_, "", "What is left of every velocity after one second; 1 damps nothing.")
        .must_be_given()
        .above(0)
        .at_most(1);
  }
  void install(System& system) const override {
    system.corrections.push_back(std::make_unique<VelocityDecay>(factor_));
  }

 private:
  double factor_ = 1;
};

}  // namespace

std::unique_ptr<Effect> make_damping() { return std::make_unique<Damping>(); }

}  // namespace drape
