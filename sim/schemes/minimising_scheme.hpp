#pragma once

#include <functional>
#include <memory>

#include "sim/parallel/vectors.hpp"
#include "sim/schemes/energy_books.hpp"
#include "sim/schemes/scheme.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// What schemes share that minimise a StepObjective, once or several times in a step: the solver, and what its last
/// minimisation, with which a step ends, has left.
class MinimisingScheme : public Scheme {
 public:
  using MakeSolver = std::function<std::unique_ptr<Minimiser>(const StepObjective& objective)>;

  [[nodiscard]] double residual() override { return norm(system_.threads, point_.gradient); }
  [[nodiscard]] double error() override { return solver_->error(point_); }
  [[nodiscard]] double unbalanced() override { return point_.gradient.rowwise().norm().sum(); }
  [[nodiscard]] std::optional<Accuracy> accuracy() const override { return solver_->accuracy(); }

 protected:
  /// @param duration that one minimisation covers [s]
  MinimisingScheme(const System& system, double duration, const MakeSolver& make_solver)
      : system_(system),
        objective_(system, duration),
        solver_(make_solver(objective_)),
        point_{.x = system.cloth.positions, .gradient = Vertices::Zero(system.cloth.vertex_count(), 3)},
        free_(is_free(system)) {}

  const System& system_;
  StepObjective objective_;
  std::unique_ptr<Minimiser> solver_;
  Iterate point_;
  bool free_;  // see is_free()
};

}  // namespace drape
