#include "sim/solvers/local_global.hpp"

namespace drape {
namespace {

constexpr int local_global_iterations = 100;  // the homework's

}  // namespace

LocalGlobal::LocalGlobal(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
    : FactoredMinimiser(system, objective, settings, local_global_iterations) {}

double LocalGlobal::iterate(Iterate& point) {
  const double change = factor().subtract_solution(point.gradient, point.x);
  point.value = objective().evaluate(point.x, point.gradient);
  return change;
}

AndersonHistory::AndersonHistory(Eigen::Index unknowns) {
  for (Pair& pair : pairs_) pair.residual = pair.c = Vertices::Zero(unknowns, 3);
  last_residual_ = last_c_ = best_residual_ = best_c_ = Vertices::Zero(unknowns, 3);
}

void AndersonHistory::clear() {
  count_ = oldest_ = 0;
  length_ = 1;
  begun_ = false;
}

void AndersonHistory::observe(const Vertices& residual, const Vertices& c) {
  constexpr double dependent = 1e-6;  // relative norm of a difference that the others span
  Pair& added = pairs_[(oldest_ + count_) % most_pairs];
  if (count_ == most_pairs) {
    oldest_ = (oldest_ + 1) % most_pairs;
    --count_;
  }
  added.residual = residual - last_residual_;
  added.c = c - last_c_;
  const double before = added.residual.norm();
  for (std::size_t k = 0; k < count_; ++k) {
    const Pair& kept = pairs_[(oldest_ + k) % most_pairs];
    const double share = kept.residual.cwiseProduct(added.residual).sum();
    added.residual -= share * kept.residual;
    added.c -= share * kept.c;
  }
  const double length = added.residual.norm();
  if (!(length > dependent * before)) return;
  added.residual /= length;
  added.c /= length;
  ++count_;
}

bool AndersonHistory::advance(const Vertices& residual, Vertices& c) {
  constexpr double grown = 10;  // allows for the initial growth of an iteration that does not contract
  const double norm = residual.norm();
  if (begun_ && !(norm <= grown * best_)) {
    count_ = oldest_ = 0;
    length_ /= 2;
    c = best_c_ + length_ * best_residual_;
    last_residual_ = best_residual_;
    last_c_ = best_c_;
    return false;
  }
  if (begun_) observe(residual, c);
  if (!begun_ || norm < best_) {
    best_ = norm;
    best_residual_ = residual;
    best_c_ = c;
  }
  begun_ = true;
  last_residual_ = residual;
  last_c_ = c;
  c += residual;
  for (std::size_t k = 0; k < count_; ++k) {
    const Pair& pair = pairs_[(oldest_ + k) % most_pairs];
    const double share = pair.residual.cwiseProduct(residual).sum();
    c -= share * (pair.c + pair.residual);
  }
  return true;
}

FactoredMinimiser::FactoredMinimiser(const System& system, const StepObjective& objective,
                                     const IntegratorSettings& settings, int default_max_iterations)
    : Minimiser(system, objective, settings, default_max_iterations),
      system_(system),
      factor_(system, objective.duration(), Precision::automatic) {}

void FactoredMinimiser::find_newton_step(const Iterate& point, Vertices& direction) {
  if (!newton_) newton_ = std::make_unique<ConjugateGradients>(system_, objective(), &factor_);
  newton_->solve(point.x, point.gradient, 0, direction);
}

}  // namespace drape
