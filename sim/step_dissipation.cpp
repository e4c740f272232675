#include "sim/step_dissipation.hpp"

#include <utility>

#include "sim/parallel/vectors.hpp"

namespace drape {

/// Hessian C/τ of the current step.
class StepDissipation::Hessian final : public EnergyHessian {
 public:
  explicit Hessian(const StepDissipation& of) : of_(of) {}
  void linearise(const Vertices& /*x*/, double /*time*/, double /*concavity*/) override {}
  void add_product(const Vertices& vector, Vertices& product) const override {
    scale(of_.threads_, 1 / of_.duration_, vector, of_.way_);
    of_.dashpots_->add_product(of_.way_, product);
  }
  void add_blocks(HessianBlocks& blocks) const override { of_.dashpots_->add_blocks(1 / of_.duration_, blocks); }

 private:
  const StepDissipation& of_;
};

StepDissipation::StepDissipation(std::shared_ptr<Dashpots> dashpots, double shortest, const Vertices& start,
                                 const Threads& threads)
    : dashpots_(std::move(dashpots)),
      threads_(threads),
      shortest_(shortest),
      duration_(shortest),
      start_(start),
      way_(start),
      product_(start) {
  dashpots_->set_directions(start);
}

void StepDissipation::begin(const Vertices& directions_at, const Vertices& start, double duration) {
  duration_ = duration;
  copy(threads_, start, start_);
  dashpots_->set_directions(directions_at);
}

double StepDissipation::evaluate(const Vertices& x) const {
  divided_difference(threads_, x, start_, duration_, way_);
  set_zero(threads_, product_);
  dashpots_->add_product(way_, product_);
  return duration_ / 2 * dot(threads_, way_, product_);
}

double StepDissipation::value(const Vertices& x) const { return evaluate(x); }

double StepDissipation::add_gradient(const Vertices& x, double /*time*/, Vertices& gradient) const {
  const double potential = evaluate(x);
  add_multiple(threads_, 1, product_, gradient);
  return potential;
}

std::unique_ptr<EnergyHessian> StepDissipation::make_hessian() const { return std::make_unique<Hessian>(*this); }

}  // namespace drape
